; check -m two_spindles: exit 1
; page 259780491 diagnosis 60303, wrong
; error 60303 at 6:14
N10 M3 S600
N20 G01 X0 Y0 Z0 F1000
G33 Z48 K1.5 S.OFFSET=500
N30 M30
