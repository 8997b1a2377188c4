; run: exit 1
; error 20147 at 3:1
G115
M30
