; check: exit 1
; error 20151 at 3:1
G115=15
M30
