; check: exit 0
; warning K-0101 at 3:5
G17 G21 G90
M30
