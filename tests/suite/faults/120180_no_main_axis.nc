; check: exit 1
; error 120180 at 6:1
#SET AX [X,1,0][Y,2,1][U,3,4]
G01 X1 F1000
G151 X10 Y5
U5
X20
G150
M30
