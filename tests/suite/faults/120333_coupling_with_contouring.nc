; check: exit 1
; error 120333 at 7:1
; warning 120206 at 8:1
#SET AX [X,1,0][Y,2,1][C,3,3]
#SET AX LINK [1, C=X]
G261
#ENABLE AX LINK [1]
M30
