; check: exit 0
; warning K-0101 at 4:1
; exact stop of other dialects
G61 X1 F100
G61 X2
M30
