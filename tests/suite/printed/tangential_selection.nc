; run: exit 0
; page 207837451 tangential selection and deselection (G05)
; passes X-8 Y10
; passes X-5.65685 Y4.34315
; passes X0 Y2
; passes X20 Y2
; passes X25.65685 Y4.34315
; end X28 Y10
N10 V.G.WZ_AKT.R=2
N20 G01 F1000 X-8 Y10
N30 G41 G05 X0 Y0
N40 X20
N50 G40 G05 X28 Y10
N60 M30
