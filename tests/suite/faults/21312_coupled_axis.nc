; check: exit 1
; error 21312 at 6:1
#SET AX [X,1,0][Y,2,1][C,3,3]
#SET AX LINK [1, C=Y]
#ENABLE AX LINK [1]
#SET AX [X,1,0][Y,2,1][C,3,2]
M30
