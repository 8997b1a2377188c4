; check: exit 1
; error 21056 at 3:15
#SIGNAL [ID=1 ID=2]
M30
