; check: exit 1
; error 20116 at 3:5
G54 G55
M30
