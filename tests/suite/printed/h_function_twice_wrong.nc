; check: exit 1
; page 252473483 diagnosis 20766, wrong
; error 20766 at 4:17
N10 G00 X10 H10 H10
N20 M30
