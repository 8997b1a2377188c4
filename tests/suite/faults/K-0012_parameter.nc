; check: exit 1
; error K-0012 at 3:3
X P1 F1000
M30
