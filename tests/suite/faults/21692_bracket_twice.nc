; check: exit 1
; error 21692 at 3:15
#TIMER START [[ID=1]]
M30
