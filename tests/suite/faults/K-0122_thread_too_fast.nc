; check: exit 1
; error K-0122 at 4:1
M3 S10000
G33 Z-10 K50
M30
