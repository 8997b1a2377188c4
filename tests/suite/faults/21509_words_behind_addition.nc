; check: exit 1
; error 21509 at 3:21
Z33 F100 #ADD["up"] X11 Y22
M30
