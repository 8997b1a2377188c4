; check: exit 1
; error 20902 at 3:13
#CYL [Z, Y, X0]
M30
