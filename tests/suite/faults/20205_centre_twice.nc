; check: exit 1
; error 20205 at 3:11
G02 X5 I1 I2 F1000
M30
