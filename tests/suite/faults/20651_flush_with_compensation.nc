; check: exit 1
; error 20651 at 6:1
V.G.WZ[1].R=1
D1 G41 X10 F1000
X20
#FLUSH
G40 X30
M30
