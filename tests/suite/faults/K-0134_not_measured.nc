; check: exit 1
; error K-0134 at 3:6
G101 X1
M30
