; run: exit 1
; error 20403 at 3:7
V.G.NP[97].V.X=1
M30
