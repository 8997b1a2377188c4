; check: exit 0
; warning 50130 at 4:6
; warning 120033 at 4:6
G130 X1000
M30
