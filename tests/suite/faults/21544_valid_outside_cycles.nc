; check: exit 1
; error 21544 at 3:4
P1=V.G.@P[1].VALID
M30
