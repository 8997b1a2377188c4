; check: exit 1
; error 20110 at 3:5
G10 G11
M30
