; check: exit 1
; error 20925 at 3:3
X P1 F1000
M30
