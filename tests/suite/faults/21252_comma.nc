; check: exit 1
; error 21252 at 3:10
#CALL AX [X,1 0]
M30
