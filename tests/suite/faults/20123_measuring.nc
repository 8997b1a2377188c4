; check: exit 1
; error 20123 at 3:10
G100 X10 G310 F500
M30
