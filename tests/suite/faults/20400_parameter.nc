; check: exit 1
; error 20400 at 3:1
P[1000000000]=1
M30
