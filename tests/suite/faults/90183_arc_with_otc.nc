; check -m ../../tests/suite/machines/grinding: exit 1
; error 90183 at 8:1
N20 D1
G00 X0 Y0 Z0
#OTC [RADIUS, AUTO]
#OTC ON
G237
G41 G03 X20 Y20 I0 J20 F1000
G01 Y60
G40 X0
M30
