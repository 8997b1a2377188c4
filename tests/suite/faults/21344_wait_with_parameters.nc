; check: exit 1
; error 21344 at 4:17
#SIGNAL [ID=1 P[0]=5]
#WAIT SYN [ID=1 P[0]=P1]
M30
