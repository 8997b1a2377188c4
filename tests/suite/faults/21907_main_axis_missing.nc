; check: exit 1
; error 21907 at 5:1
G18 G01 X2 F1000
#PUT AX [Z]
#ANG=30 X25
M30
