; check: exit 1
; error 21167 at 3:15
#TIMER START [ID=128]
M30
