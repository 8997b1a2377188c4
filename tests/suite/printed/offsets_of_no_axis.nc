; check: exit 0
; page 15651573131 diagnosis 20003, wrong
; warning 20003 at 5:5
N10 G00 X0 Y0 Z0
N20 G160=2
N30 M30
