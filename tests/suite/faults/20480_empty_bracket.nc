; check: exit 1
; error 20480 at 3:9
#SET TIP[ ] X
M30
