; check: exit 1
; error 20108 at 3:8
G01 X1 G00 F1000
M30
