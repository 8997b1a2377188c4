; check: exit 0
; page 264471947 diagnosis 120206
; warning 120206 at 7:1
N10 G261
N20 G01 X10 F1000
N30 Y10
N40 M30
