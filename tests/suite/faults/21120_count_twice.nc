; check: exit 1
; error 21120 at 3:23
#SIGNAL [ID=1 COUNT=2 COUNT=3]
M30
