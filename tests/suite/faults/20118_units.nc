; check: exit 1
; error 20118 at 3:5
G70 G71
M30
