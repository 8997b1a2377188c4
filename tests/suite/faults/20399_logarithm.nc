; check: exit 1
; error 20399 at 3:8
P1=LOG[0]
M30
