; check: exit 1
; error 20772 at 3:1
G100 X10 F500 G106
M30
