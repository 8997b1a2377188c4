; check: exit 1
; error 90123 at 9:1
V.G.WZ[1].R=5
D1 G00 X20 Y5
; the tool enters the contour at (15, 5), less than 5 mm away from (16, 9)
G238 G41 G01 X10 Y0 F1000
X30
Y20
X16 Y9
X10 Y8
Y0
G40 X20 Y5
M30
