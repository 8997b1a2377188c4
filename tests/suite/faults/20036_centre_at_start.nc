; check: exit 1
; error 20036 at 3:14
G164 G02 X10 I0 J0 F1000
M30
