; check: exit 1
; error 21549 at 4:13
#SIGNAL [ID=1]
#WAIT [ID=1 P[0]=P1]
M30
