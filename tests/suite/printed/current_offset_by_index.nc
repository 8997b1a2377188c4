; run: exit 0
; page 206505739 zero offset in use, by the index of the axis and for all axes
; end X202 Y2
N05 V.G.NP[2].V.X=1 V.G.NP[2].V.Y=1
N10 V.G.NP_AKT.V[0] = 200
N20 V.G.NP_AKT.ALL = V.G.NP_AKT.ALL + V.G.NP[2].ALL
N30 V.G.NP_AKT.ALL += V.G.NP[2].ALL
N40 V.G.NP[1].ALL = V.G.NP_AKT.ALL
N50 G53
N60 G54 G01 F6000 X0 Y0
M30
