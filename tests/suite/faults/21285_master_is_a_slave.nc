; check: exit 1
; error 21285 at 7:1
#SET AX [X,1,0][B,2,4][C,3,3]
#SET AX LINK [1, B=C]
#SET AX LINK [2, C=X]
#ENABLE AX LINK [2]
#ENABLE AX LINK [1]
M30
