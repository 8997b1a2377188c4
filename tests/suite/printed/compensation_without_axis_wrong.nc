; check: exit 1
; page 250898059 diagnosis 20136, wrong
; error 20136 at 6:5
N10 G00 X0 Y0 Z0
N20 #PUT AX[X]
N30 G41
N40 M30
