; check: exit 1
; error 20197 at 3:10
P1=V.G.WZ[-1].L
M30
