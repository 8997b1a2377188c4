; check: exit 1
; error 21306 at 3:16
#MAIN SPINDLE [9]
M30
