; check: exit 0
; warning K-0109 at 3:12
G1 X5 F100 R5
M30
