; check: exit 1
; error 20712 at 3:1
G115=-1
M30
