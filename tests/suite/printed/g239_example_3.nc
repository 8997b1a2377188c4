; run: exit 0
; page 207810059 selection without a block (G239), beginning of example 3
; passes X30 Y30
; passes X60 Y30
; end X90 Y0
N10 G0 X0 Y0 Z0 F1000
N20 G239
N30 V.G.WZ_AKT.R = 10
N40 G41 G01 X30 Y20
N50 G01 X60
N60 G40
N70 G00 X90 Y0
N80 M30
