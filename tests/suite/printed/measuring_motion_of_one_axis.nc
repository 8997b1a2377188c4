; run --input x25.csv: exit 0
; page 15556657291 measuring with one axis (G100, type 2)
; end X7 Y5
; passes X25 Y5
N10 G00 X0 Y0 Z0
N20 Y5
N25 #MEAS MODE[2]
N30 G100 X100 F6000
N40 G01 X7
N50 M30
