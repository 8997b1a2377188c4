; run: exit 0
; page 318262795 tool data in use (V.G.WZ_AKT)
; end X5 Y5
N10 V.G.WZ_AKT.R = 5
N20 G00 X[V.G.WZ_AKT.R] Y[V.G.WZR]
N30 M30
