; check: exit 1
; page 250806667 diagnosis 20112, wrong
; error 20112 at 6:17
; warning K-0101 at 6:5
N10 G00 X0 Y0 Z0
N20 G20 X10 Y20 G21
N30 M30
