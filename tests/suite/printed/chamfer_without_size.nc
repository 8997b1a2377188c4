; check: exit 1
; page 250528139 diagnosis 20012, chamfers, wrong
; error 20012 at 6:5
N10 G00 X0 Y0 Z0
N20 G01 X10 F2000
N30 G301
N40 G01 Y10
N50 M30
