; check: exit 1
; error 20160 at 4:5
N10 G00 X0
N20 M1001
M30
