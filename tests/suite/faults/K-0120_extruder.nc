; check: exit 1
; error K-0120 at 4:1
G01 X1 F100
G92 E0
X2 E1.0
M30
