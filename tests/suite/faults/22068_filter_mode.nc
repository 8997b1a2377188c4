; check: exit 1
; error 22068 at 3:13
#FILTER ON [MODE=1]
M30
