; check: exit 0
; warning 20375 at 3:5
N10 $IF 1
X1 F1000
M30
