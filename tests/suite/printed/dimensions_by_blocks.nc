; run: exit 0
; page 15556691083 dimensions for whole blocks (G90, G91)
; passes X10 Y10
; end X30 Y30 Z5
N05 F6000
N10 X10 Y10
N20 G91 X20 Y20
N30 X30 G90 Y30
N40 Z5
M30
