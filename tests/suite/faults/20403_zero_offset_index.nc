; check: exit 1
; error 20403 at 3:11
P10=V.G.NP[-1].V[0]
M30
