; check: exit 1
; error 20194 at 3:1
P1 5
M30
