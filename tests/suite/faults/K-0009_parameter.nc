; check: exit 1
; error K-0009 at 3:1
P[1000000000]=1
M30
