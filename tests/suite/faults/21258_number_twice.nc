; check: exit 1
; error 21258 at 3:20
#CALL AX [X,1,0][Y,1,1]
M30
