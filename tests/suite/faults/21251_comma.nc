; check: exit 1
; error 21251 at 3:11
#CALL AX [X 1 0]
M30
