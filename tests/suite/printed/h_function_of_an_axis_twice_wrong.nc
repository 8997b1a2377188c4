; check: exit 1
; page 252473483 diagnosis 20766, wrong
; error 20766 at 4:22
N10 G00 X10 X[H10] X[H10]
N20 M30
