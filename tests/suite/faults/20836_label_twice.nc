; check: exit 1
; error 20836 at 4:1
N1: X1 F1000
N1: X2
M30
