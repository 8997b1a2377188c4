; check: exit 1
; error 20133 at 6:1
V.G.WZ[1].R=1
D1 G41 X10 F1000
X20
G18
G40 X30
M30
