; run: exit 0
; page 250602123 diagnosis 20034, right
; passes X10 Y10
; passes X20 Y0
; passes X10 Y-10
; end X0 Y0
N10 G00 X0 Y0 Z0
N20 G02 I10 F1000
N30 M30
