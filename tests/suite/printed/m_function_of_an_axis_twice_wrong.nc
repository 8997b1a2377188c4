; check: exit 1
; page 252469131 diagnosis 20765, wrong
; error 20765 at 4:22
N10 G00 X10 X[M10] X[M10]
N20 M30
