; check: exit 1
; error 21318 at 6:1
V.G.WZ_AKT.R=2
G238 G41 X10 F100
X20
G139
M30
