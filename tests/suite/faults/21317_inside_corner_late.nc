; check: exit 1
; error 21317 at 5:1
V.G.WZ_AKT.R=2
G41 X10 F100
G238
M30
