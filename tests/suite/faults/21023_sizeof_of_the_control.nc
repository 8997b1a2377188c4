; check: exit 1
; error 21023 at 3:13
P1 = SIZEOF[V.G.WZ_AKT.V[1]]
M30
