; check: exit 1
; error 20138 at 4:1
#MEAS MODE [5]
G100 X10 F500
M30
