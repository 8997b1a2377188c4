; run: exit 1
; error 20574 at 4:7
P1=3 P2=0
P1 /= P2
M30
