; check: exit 1
; page 250858891 diagnosis 20124, wrong
; error 20124 at 6:12
; warning K-0111 at 6:5
N10 G00 X0 Y0 Z0
N20 G115=2 G116 X1
N30 M30
