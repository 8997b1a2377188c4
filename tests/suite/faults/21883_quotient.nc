; check: exit 1
; error 21883 at 4:6
P1 = 10**200
P2 = P1 / 10**-200
M30
