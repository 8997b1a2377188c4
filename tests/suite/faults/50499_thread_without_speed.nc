; check: exit 1
; note K-0109 at 4:1
; error 50499 at 5:1
M3 S0
G33 Z10 K1
M30
