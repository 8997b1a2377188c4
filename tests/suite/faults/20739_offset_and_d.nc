; run: exit 1
; error 20739 at 4:4
V.G.WZ[1].R=1
D1 V.G.WZ_AKT.V[1]=40
M30
