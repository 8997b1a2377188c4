; check: exit 1
; error 20400 at 3:1
P0=10
M30
