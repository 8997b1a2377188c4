; check: exit 1
; page 250610827 diagnosis 20036, second wrong
; error 20036 at 5:10
N10 G00 X0 Y0 Z0
N20 G164 G02 X0 F1000
N30 M30
