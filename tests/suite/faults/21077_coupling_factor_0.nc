; check: exit 1
; error 21077 at 3:26
#SET AX LINK [1, [Y = X, 0, 1]]
M30
