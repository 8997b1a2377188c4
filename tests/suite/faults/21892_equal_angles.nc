; check: exit 1
; error 21892 at 5:1
G18 G1 Z15 X10 F1000
#ANG 60
#ANG 60 Z40 X30
M30
