; check: exit 1
; error 20083 at 4:4
V.G.WZ[1].R=2
D1 V.G.WZ_AKT.R=3
M30
