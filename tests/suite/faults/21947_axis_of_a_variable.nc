; check: exit 1
; error 21947 at 3:4
P1=V.A.ABS.Q
M30
