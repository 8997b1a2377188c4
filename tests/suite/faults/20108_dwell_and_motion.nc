; check: exit 1
; error 20108 at 3:8
G04 X1 G01
M30
