; check: exit 1
; error 20396 at 3:8
P2=TAN[90]
M30
