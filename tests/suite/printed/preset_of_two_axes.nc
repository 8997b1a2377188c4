; run: exit 0
; page 15556648587 reference point offset (G92), older page
; passes X11 Z32
; end X1 Z2
N10 G90 F6000
N20 G92 X10 Z30
N30 G01 X1 Z2
N40 G92 X0 Z0
N50 X1 Z2
N60 M30
