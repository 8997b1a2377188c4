; check: exit 1
; error 20476 at 3:23
#SET AX LINK [1, Z=X, Z=Y]
M30
