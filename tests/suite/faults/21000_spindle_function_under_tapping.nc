; check: exit 1
; error 21000 at 4:1
G63 Z-10 F100 S100
M5
M30
