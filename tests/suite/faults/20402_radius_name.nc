; check: exit 1
; error 20402 at 3:1
R3=5
M30
