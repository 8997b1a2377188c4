; check: exit 1
; error 20387 at 3:4
P2=SIN45]
M30
