; check: exit 1
; error 20795 at 3:5
N10 G13
N20 G01 X10 F1000
M30
