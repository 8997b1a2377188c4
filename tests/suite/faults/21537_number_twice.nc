; check: exit 1
; error 21537 at 3:19
#TIMER START [ID1 ID2]
M30
