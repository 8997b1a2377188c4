; check: exit 1
; error 20998 at 3:7
#WAIT LATER
M30
