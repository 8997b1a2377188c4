; check: exit 1
; error 20191 at 3:1
O9999999999
M30
