; check: exit 1
; error 90008 at 5:1
V.G.WZ[1].R=1
D1 G41
G02 X10 I5 F1000
G40 G01 X20
M30
