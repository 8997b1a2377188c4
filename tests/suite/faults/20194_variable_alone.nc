; check: exit 1
; error 20194 at 3:1
V.P.A
M30
