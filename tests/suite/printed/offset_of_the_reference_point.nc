; run: exit 0
; page 206145291 reference point offset (G92)
; passes X15 Z35
; end X5 Z35
N10 G90
N20 G92 X10 Z30
N30 G01 X5 Z5 F1000
N40 G92 X0 Z0
N50 X5
N60 M30
