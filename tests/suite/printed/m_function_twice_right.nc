; run: exit 0
; page 252469131 diagnosis 20765, right
N10 G00 X10 M10 X[M10] S[M10]
N20 M30
