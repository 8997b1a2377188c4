; run: exit 1
; error 22159 at 4:1
F1000
G163=3 G02 X4 I2
M30
