; check: exit 1
; error 20996 at 3:15
#SIGNAL [ID=1 CH=0]
M30
