; check: exit 1
; error K-0002 at 3:5
G92 G68 X1
M30
