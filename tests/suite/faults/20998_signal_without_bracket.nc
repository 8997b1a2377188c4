; check: exit 1
; error 20998 at 3:9
#SIGNAL LATER
M30
