; check: exit 1
; page 250876299 diagnosis 20128, wrong
; error 20128 at 7:25
; note K-0109 at 7:10
; error 20008 at 7:18
N10 G00 X0 Y0 Z0
N20 G165 G02 I10 X20.05 G164
N30 M30
