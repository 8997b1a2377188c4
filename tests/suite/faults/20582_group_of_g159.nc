; check: exit 1
; error 20582 at 3:1
G159=-1
M30
