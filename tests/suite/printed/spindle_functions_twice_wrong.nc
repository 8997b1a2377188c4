; check: exit 1
; page 250928523 diagnosis 20155, wrong
; error 20155 at 5:20
N10 G00 X0 Y0 Z0
N20 X10 S[M3 S1000 M4]
N30 M30
