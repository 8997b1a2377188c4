; check: exit 1
; error 120169 at 3:1
G196 S0
M30
