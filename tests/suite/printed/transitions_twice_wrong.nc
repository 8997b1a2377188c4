; check: exit 1
; page 250828427 diagnosis 20117, wrong
; error 20117 at 5:15
N10 G00 X0 Y0 Z0
N20 G360 X100 G60
N30 M30
