; check: exit 0
; warning K-0119 at 10:1
V.G.WZ_AKT.R=0.5
G26 F2000
G01 X-20 Y0
G41 X0 Y0
X40
V.G.WZ_AKT.R=9
(at the distance of the new radius at its end, 7.962 mm from the line before)
X42 Y3.4641
X60 Y34.641
G40 X70
M30
