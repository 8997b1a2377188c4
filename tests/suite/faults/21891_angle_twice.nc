; check: exit 1
; error 21891 at 4:9
G01 X10 F1000
#ANG=30 #ANG=40 X20
M30
