; check: exit 1
; error 20008 at 3:5
G01 X10
M30
