; check: exit 1
; error 20131 at 3:9
N40 G01 G777 X25 Y-3 F1500
M30
