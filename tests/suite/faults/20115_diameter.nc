; check: exit 1
; error 20115 at 3:5
G52 G51
M30
