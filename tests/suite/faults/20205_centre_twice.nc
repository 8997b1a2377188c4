; check: exit 1
; error 20205 at 3:13
G02 X5 I2.5 I2.5 F1000
M30
