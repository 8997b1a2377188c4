; check: exit 1
; error 20956 at 3:1
G310 G01 X10 F500
M30
