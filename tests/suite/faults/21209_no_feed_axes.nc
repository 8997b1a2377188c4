; check: exit 0
; warning 21209 at 3:1
#FGROUP
G01 X10 F1000
M30
