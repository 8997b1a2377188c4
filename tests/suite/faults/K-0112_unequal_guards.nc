; run --set X.vib_guard.active=1: exit 0
; warning K-0112 at -
N10 X1 F1000
N20 Y1
M30
