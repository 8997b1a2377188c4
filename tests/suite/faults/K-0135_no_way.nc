; check: exit 1
; error K-0135 at 3:1
G100 X0 F500
M30
