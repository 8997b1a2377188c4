; check: exit 0
; warning K-0119 at 8:1
F3000
G26 G139
V.G.WZ_AKT.R=1
G00 X-5 Y-5
G01 G41 X0 Y0
G03 X-1.2061 Y-6.8404 I-20 J0 (comes within 0.684 mm of the line that follows it)
G01 X1 Y10
G40 X-5 Y20
M30
