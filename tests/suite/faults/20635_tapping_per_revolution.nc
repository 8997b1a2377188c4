; check: exit 1
; error 20635 at 4:1
G95 F1
G63 Z-10 S200
M30
