; check: exit 1
; error 21897 at 3:8
G01 Y1 X501 F1000
M30
