; check: exit 1
; error 20036 at 3:6
G164 G02 X10 F1000
M30
