; check: exit 1
; error 20954 at 3:1
G100 G02 X10 Y0 I5 F500
M30
