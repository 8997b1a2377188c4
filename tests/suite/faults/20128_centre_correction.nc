; check: exit 1
; error 20128 at 3:6
G164 G165
M30
