; check: exit 0
; warning 50130 at 3:1
G133=1
M30
