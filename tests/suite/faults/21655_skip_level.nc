; check: exit 1
; error 21655 at 3:1
/11 N10 X1 F100
N20 M30
