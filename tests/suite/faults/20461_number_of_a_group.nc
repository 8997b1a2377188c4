; check: exit 1
; error 20461 at 3:15
#SET AX LINK [100000, Y=X]
M30
