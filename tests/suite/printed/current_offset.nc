; run: exit 0
; page 15556751499 current zero offset (V.G.NP_AKT)
; end X210
N10 V.G.NP_AKT.V.X = 200
N20 G00 X10
N30 M30
