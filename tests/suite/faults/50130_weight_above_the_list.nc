; check: exit 0
; warning 50130 at 4:1
; warning 120033 at 4:1
G131=500
M30
