; check: exit 1
; error 20194 at 3:6
V.P.A
M30
