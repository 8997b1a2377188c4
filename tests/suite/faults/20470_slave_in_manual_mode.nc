; check: exit 1
; warning K-0111 at 5:1
; error 20470 at 7:1
#SET AX [X,1,0][Y,2,1][C,3,3]
G201 #ACHSE [C]
#SET AX LINK [1, C=X]
#ENABLE AX LINK [1]
M30
