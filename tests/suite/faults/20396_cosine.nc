; check: exit 1
; error 20396 at 3:7
P2=10/COS[90]
M30
