; check: exit 1
; error 120173 at 5:1
#PUT AX [Z]
S100 M3
G33 X10 K1
M30
