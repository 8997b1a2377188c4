; check: exit 1
; error 21059 at 3:25
#SIGNAL [ID=44 P[0]=200 P[0]=944]
M30
