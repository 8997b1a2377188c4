; check: exit 1
; error 21220 at 3:8
#FLUSH NEVER
M30
