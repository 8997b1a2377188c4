; run: exit 0
; page 15556747403 zero offset in use saved in the list
; end X30
N10 V.G.NP_AKT.V.X = 30
N20 V.G.NP[12].ALL=V.G.NP_AKT.ALL
N30 G53
N40 G159=12 G01 F1000 X0
M30
