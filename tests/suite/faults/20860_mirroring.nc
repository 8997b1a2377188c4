; check: exit 1
; error 20860 at 3:6
G351 X2
M30
