; check: exit 1
; page 250776203 diagnosis 20105, wrong
; error 20105 at 5:9
N10 G00 X0 Y0 Z0
N20 X10 N30
N1000 M30
