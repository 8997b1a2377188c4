; check: exit 1
; warning K-0114 at 6:1
; error 20457 at 7:1
#SET AX [X,1,0][Y,2,1][C,3,3]
#SET AX LINK [1, C=X]
G41
#ENABLE AX LINK [1]
X10 F1000
M30
