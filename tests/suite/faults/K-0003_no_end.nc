; check: exit 0
; warning K-0003 at 4:1
N10 X1 F1000
N20 X2
