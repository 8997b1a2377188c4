; check: exit 0
; warning K-0114 at 3:1
D5
M30
