; check: exit 0
; warning K-0109 at 3:9
G2 F100 R5
M30
