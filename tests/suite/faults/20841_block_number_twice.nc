; check: exit 1
; error 20841 at 3:6
N100 N100: X1 F1000
M30
