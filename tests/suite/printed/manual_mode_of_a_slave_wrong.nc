; check: exit 1
; page 251694475 diagnosis 20470, wrong
; warning K-0111 at 7:5
; error 20470 at 9:6
N10 G00 X0 Y0 Z0
#SET AX [X,1,0][Y,2,1][B,3,3]
N20 G201 #ACHSE [B]
N100 #SET AX LINK [1, B=X]
N110 #ENABLE AX LINK[1]
N1000 M30
