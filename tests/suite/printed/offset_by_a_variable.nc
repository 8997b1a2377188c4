; run: exit 0
; page 206487307 zero offsets by variables (V.G.NP)
; end X110
V.G.NP[1].V.X=10
G54
G0 X=100
M30
