; check: exit 0
; warning 50130 at 3:1
G131=500
M30
