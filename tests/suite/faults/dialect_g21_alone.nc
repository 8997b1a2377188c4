; check: exit 0
; warning K-0101 at 4:9
; millimetres of other dialects: X is mirrored here
N10 G17 G21 G90
N20 X10 F1000
N30 G21 X5
M30
