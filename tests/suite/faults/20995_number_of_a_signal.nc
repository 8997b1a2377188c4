; check: exit 1
; error 20995 at 3:10
#SIGNAL [ID=-1]
M30
