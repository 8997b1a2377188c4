; check: exit 1
; error K-0123 at 4:1
M3 S100
G63 Z-10 F100
M30
