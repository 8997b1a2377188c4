; check: exit 1
; page 250536843 diagnosis 20014, wrong
; error 20014 at 5:9
N10 G00 X0 Y0 Z0
N20 G04 Y2
N30 M30
