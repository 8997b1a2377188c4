; check: exit 1
; error 20008 at 3:12
N10 G01 F0 X10
M30
