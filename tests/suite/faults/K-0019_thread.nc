; check: exit 1
; error K-0019 at 3:1
G33 Z10 F1000
M30
