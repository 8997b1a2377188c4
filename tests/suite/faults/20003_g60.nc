; check: exit 0
; warning 20003 at 3:1
G60
M30
