; check: exit 1
; error 21277 at 7:1
#SET AX [X,1,0][Y,2,1][C,3,3]
#SAVE CONFIG [AX]
#SET AX LINK [1, C=X]
#ENABLE AX LINK [1]
#LOAD CONFIG [AX]
M30
