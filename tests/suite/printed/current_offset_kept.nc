; run: exit 0
; page 15556751499 current zero offset kept for later
; end Y13
N05 V.G.NP_AKT.V.Y=12
N10 V.G.NP[1].ALL = V.G.NP_AKT.ALL
N20 G53
N30 G54 G00 Y1
N40 M30
