; check: exit 1
; error 20844 at 3:7
G04 2 G04 3
M30
