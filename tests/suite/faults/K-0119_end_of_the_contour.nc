; check: exit 0
; warning K-0119 at 10:1
F3000
G26 G237
V.G.WZ_AKT.R=1
G00 X-10 Y0
G01 G41 X20
Y-20
X10
Y-0.5 (comes from below, to 0.5 mm from the first line)
G40 X0 Y-10
M30
