; check: exit 1
; error 20007 at 3:1
G63 Z10 F300 S0
M30
