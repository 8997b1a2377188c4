; check: exit 1
; error 20192 at 3:1
O1000
M30
