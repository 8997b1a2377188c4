; check: exit 1
; page 251816331 diagnosis 20535, wrong
; error 20535 at 5:5
N10 G63 Z10 F1000 S100
N20 #SET AX[X, 1, 0]
N30 M30
