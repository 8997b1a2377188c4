; check: exit 1
; error 20836 at 4:5
N10 [A] X1 F1000
N20 [A] X2
M30
