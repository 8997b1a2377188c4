; check: exit 1
; error 20117 at 3:6
G260 G360
M30
