; check: exit 1
; error 21257 at 3:22
#CALL AX [X,1,0][Y,2,0]
M30
