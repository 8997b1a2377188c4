; check: exit 1
; page 252664971 diagnosis 20821, wrong
; error 20821 at 5:5
N10 G00 X0 Y0 Z0
N20 #CS ON
N30 G01 X10 F1000
N40 M30
