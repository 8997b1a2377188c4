; run --set X.kenngr.achs_mode=65: exit 1
; error 20641 at 5:1
G18 G00 X20
G96 S63
#SET AX [X,1,1][Y,2,0][Z,3,2]
M30
