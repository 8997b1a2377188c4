; check: exit 1
; page 252791179 diagnosis 20860, value of G351
; error 20860 at 5:10
N10 G00 X0 Y0 Z0
N20 G351 X2
N30 M30
