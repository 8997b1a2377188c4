; check: exit 0
; warning K-0157 at 3:8
G04 X1 F100
M30
