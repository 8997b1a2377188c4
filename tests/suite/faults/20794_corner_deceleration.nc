; check: exit 1
; error 20794 at 3:5
G12 G13
M30
