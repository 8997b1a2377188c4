; check: exit 1
; error 20480 at 3:1
#GEAR LINK []
M30
