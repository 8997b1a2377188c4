; check: exit 1
; error 20192 at 4:1
; nothing after the number of a Fanuc program is checked
O1000 (TEST)
G43 H1
G80
M98 P2000
M30
