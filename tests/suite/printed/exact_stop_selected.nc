; run: exit 0
; page 206301707 exact stop of all blocks (G360, G359)
; passes X10 Y20
; end X30 Y20
N10 G1 F1000 X0 Y0
N20 G1 X10
N30 G360
N40 G1 Y20
N60 G1 X30
N70 G359
M30
