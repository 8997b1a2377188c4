; check: exit 1
; error 20846 at 3:6
G166 G166 X1 F1000
M30
