; check: exit 0
; warning 21111 at 3:26
#SET AX LINK [1, [Y = X, -1, 2]]
X1 F1000
M30
