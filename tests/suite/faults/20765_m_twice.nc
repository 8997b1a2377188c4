; check: exit 1
; error 20765 at 3:5
M10 M10
M30
