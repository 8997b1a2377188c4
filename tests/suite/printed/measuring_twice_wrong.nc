; check: exit 1
; page 250854539 diagnosis 20123, wrong
; error 20123 at 6:15
; error 20008 at 6:10
N10 G00 X0 Y0 Z0
N20 G100 X100 G102
N30 M30
