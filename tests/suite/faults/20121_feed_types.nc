; check: exit 1
; error 20121 at 3:5
G94 G95
M30
