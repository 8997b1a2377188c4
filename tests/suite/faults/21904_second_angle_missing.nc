; check: exit 1
; error 21904 at 5:1
G18 G1 Z15 X2 F1000
#ANG=30
G1 Z40 X30
M30
