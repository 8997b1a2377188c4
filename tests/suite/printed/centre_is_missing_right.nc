; run: exit 0
; page 250610827 diagnosis 20036, right
; passes X5 Y5
; end X10 Y0
N10 G00 X0 Y0 Z0
N20 G164 G02 X10 I5 F1000
N30 M30
