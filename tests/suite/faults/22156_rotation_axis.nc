; check: exit 1
; error 22156 at 3:9
G68 R30 Z5
M30
