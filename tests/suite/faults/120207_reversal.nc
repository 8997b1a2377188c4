; run: exit 0
; warning 120207 at 3:1
G261 X10 F1000
X0
G260
M30
