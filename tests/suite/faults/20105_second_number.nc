; check: exit 1
; error 20105 at 3:11
N20 P1=10 N30
M30
