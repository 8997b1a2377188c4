; check: exit 0
; warning K-0101 at 5:5
; warning K-0101 at 7:5
; each word once
N10 G20
N20 X1 F100
N30 G21
N40 X2
N50 G20 X3
N60 G21
M30
