; check: exit 1
; error 20475 at 3:18
#SET AX LINK [1, X=X]
M30
