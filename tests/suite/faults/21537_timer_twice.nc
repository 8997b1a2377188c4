; check: exit 1
; error 21537 at 3:1
#TIMER START [ID=1 ID=2]
M30
