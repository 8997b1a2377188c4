; check: exit 1
; page 250515083 diagnosis 20008, wrong
; error 20008 at 5:9
N10 G00 X0 Y0 Z0
N20 G01 X10
N30 M30
