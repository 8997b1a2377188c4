; check: exit 1
; error 20916 at 4:13
; error 20200 at 4:12
P1 = SIZEOF[NAME]
M30
