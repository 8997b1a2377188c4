; check: exit 1
; error K-0124 at 4:1
M3 S100
G33 Z-10
M30
