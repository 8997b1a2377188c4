; check: exit 0
; warning 120206 at 5:1
G261 X10 F1000
Y10
M30
