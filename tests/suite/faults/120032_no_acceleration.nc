; check: exit 0
; warning 120032 at 4:6
; warning 120034 at 4:6
G130 X0
G130 X100
G01 X1 F1000
M30
