; check: exit 1
; page 250824075 diagnosis 20116, wrong
; error 20116 at 5:17
N10 G00 X0 Y0 Z0
N20 G53 X10 Y10 G54
N30 M30
