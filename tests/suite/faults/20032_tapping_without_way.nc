; check: exit 1
; error 20032 at 3:5
G63 Z0 F100 S100
M30
