; check: exit 0
; note K-0109 at 4:5
G95 F1 S600
G01 X5
M30
