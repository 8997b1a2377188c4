; check: exit 1
; page 250815371 diagnosis 20114, wrong
; error 20114 at 6:17
; warning K-0114 at 6:5
N10 G00 X0 Y0 Z0
N20 G41 X10 Y20 G42
N30 M30
