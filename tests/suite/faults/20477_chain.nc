; check: exit 1
; error 20477 at 3:23
#SET AX LINK [1, Y=X, Z=Y]
M30
