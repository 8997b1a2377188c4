; run: exit 0
; page 252473483 diagnosis 20766, right
N10 G00 X10 H10 X[H10] S[H10]
N20 M30
