; check: exit 1
; page 253030539 diagnosis 20932, wrong
; error 20932 at 5:13
N10 G00 X0
N20 #DELETE V.P.NOT_THERE
M30
