; check: exit 1
; error 21895 at 4:1
G17 G1 X10 Y10 F1000
#ANG=45 X20 Y25
M30
