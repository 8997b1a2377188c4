; check: exit 1
; page 250532491 diagnosis 20013, wrong
; error 20013 at 5:5
N10 G00 X0 Y0 Z0
N20 G04 10 X2
N30 M30
