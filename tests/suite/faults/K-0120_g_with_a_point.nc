; check: exit 1
; error K-0120 at 3:5
G90 G54.1 P1
X1 F100
M30
