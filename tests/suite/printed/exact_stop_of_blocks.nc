; run: exit 0
; page 206301707 exact stop of single blocks (G60)
; passes X10 Y0
; passes X20 Y20
; end X30 Y20
N10 G1 F1000 X0 Y0
N20 G1 G60 X10
N30 G1 X20
N40 G60 Y20
N50 G1 X30
M30
