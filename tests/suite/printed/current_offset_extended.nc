; run: exit 0
; page 15556751499 current zero offset with those of another group
; passes X207 Y3
; end X214 Y6
N05 V.G.NP[2].V.X=7
N06 V.G.NP[2].V.Y=3
N07 V.G.NP_AKT.V.X=200
N10 V.G.NP_AKT.ALL += V.G.NP[2].ALL
N20 G00 X0 Y0
N30 V.G.NP_AKT.ALL = V.G.NP_AKT.ALL + V.G.NP[2].ALL
N40 G00 X0 Y0
N50 M30
