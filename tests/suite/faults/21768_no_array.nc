; check: exit 1
; error 21768 at 4:6
V.P.A = 5
P1 = V.P.A[1]
M30
