; check: exit 1
; page 250602123 diagnosis 20034, wrong
; error 20034 at 5:15
N10 G00 X0 Y0 Z0
N20 G02 X0 Y0 R10 F1000
N30 M30
