; check: exit 1
; page 252752011 diagnosis 20844, wrong
; error 20844 at 5:11
N10 G00 X0 Y0 Z0
N20 G04 2 G04 3
N30 M30
