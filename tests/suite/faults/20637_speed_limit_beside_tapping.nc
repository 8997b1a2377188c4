; check: exit 1
; error 20637 at 3:5
G63 G196 S1000 Z5 F100
M30
