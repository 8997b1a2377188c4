; check: exit 1
; error 20013 at 3:1
G04 2 X3
M30
