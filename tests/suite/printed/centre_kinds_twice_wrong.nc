; check: exit 1
; page 250871947 diagnosis 20127, wrong
; error 20127 at 6:22
; error 20008 at 6:18
N10 G00 X0 Y0 Z0
N20 G02 G162 I10 X20 G162
N30 M30
