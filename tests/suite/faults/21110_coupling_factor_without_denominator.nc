; check: exit 1
; error 21110 at 3:26
#SET AX LINK [1, [Y = X, -1]]
M30
