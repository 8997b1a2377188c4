; run: exit 0
; page 250515083 diagnosis 20008, right
; end X10
N10 G00 X0 Y0 Z0
N20 G01 X10 F1000
N30 M30
