; check: exit 1
; error 20124 at 3:6
G116 G117
M30
