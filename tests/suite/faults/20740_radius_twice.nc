; run: exit 1
; error 20740 at 3:33
V.G.WZ_AKT.R=25 X10 Y20 F600    V.G.WZ_AKT.R=30
M30
