; check: exit 1
; error 20916 at 3:13
P1 = SIZEOF[NAME]
M30
