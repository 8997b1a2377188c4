; check: exit 1
; error 21283 at 7:1
#SET AX [X,1,0][Y,2,1][C,3,3]
#SET AX LINK [1, C=X]
#SET AX LINK [2, C=Y]
#ENABLE AX LINK [1]
#ENABLE AX LINK [2]
M30
