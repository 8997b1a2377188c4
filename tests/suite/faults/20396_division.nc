; check: exit 1
; error 20396 at 4:7
P1=0
P2=10/P1
M30
