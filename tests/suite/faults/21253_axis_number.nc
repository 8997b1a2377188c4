; check: exit 1
; error 21253 at 3:13
#CALL AX [X,99999999,0]
M30
