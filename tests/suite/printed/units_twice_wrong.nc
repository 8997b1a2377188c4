; check: exit 1
; page 250832779 diagnosis 20118, wrong
; error 20118 at 5:13
N10 G00 X0 Y0 Z0
N20 G70 X10 G71
N30 M30
