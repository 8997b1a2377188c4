; check: exit 1
; error K-0120 at 3:11
G2 X10 Y0 CR=5 F100
CYCLE81(5, 1, 2)
M30
