; run: exit 0
; page 15557116555 tool data of another tool (V.G.WZ)
; end X12 Z30
N10 V.G.WZ[5].V.X = 12
N20 V.G.WZ[5].L = 30
N30 G00 X[V.G.WZ[5].V[0]] Z[V.G.WZ[5].L]
N40 M30
