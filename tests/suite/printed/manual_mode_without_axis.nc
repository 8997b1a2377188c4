; check: exit 1
; page 250619531 diagnosis 20038, wrong
; error 20038 at 5:5
N10 G00 X0 Y0 Z0
N20 G201
N30 M30
