; check: exit 1
; error 20166 at 4:5
N10 G00 X0
N20 T2147483648
M30
