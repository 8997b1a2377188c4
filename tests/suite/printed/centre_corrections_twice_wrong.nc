; check: exit 1
; page 250876299 diagnosis 20128, wrong
; error 20128 at 6:25
; error 20008 at 6:18
N10 G00 X0 Y0 Z0
N20 G165 G02 I10 X20.05 G164
N30 M30
