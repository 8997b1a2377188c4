; check: exit 1
; error 21537 at 3:1
#TIMER START STOP [ID=1]
M30
