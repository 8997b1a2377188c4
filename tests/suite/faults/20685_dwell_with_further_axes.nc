; check: exit 0
; warning 20685 at 3:8
G04 X2 Y3
M30
