; run: exit 0
; page 206529291 offsets of single axes (G160)
; end X1 Y7 Z1
N10 V.G.NP[2].V.X=5
N20 V.G.NP[2].V.Y=6
N30 V.G.NP[2].V.Z=7
N40 G160 = 2 X1 Y0 Z1
N50 G55
N60 G01 X1 Y1 Z1 F1000
N70 M30
