; run: exit 1
; error 20149 at 4:1
G00 X0 Y0 Z0
G159=500
X1 F100
M30
