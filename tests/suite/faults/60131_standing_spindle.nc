; check: exit 1
; error 60131 at 4:5
G95 F1
G01 X10
M30
