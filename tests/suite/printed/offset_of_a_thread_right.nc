; run -m two_spindles: exit 0
; page 259780491 diagnosis 60303, right
N10 M3 S600
N20 G01 X0 Y0 Z0 F1000
G33 Z48 K1.5 S.OFFSET=180
N30 M30
