; run --set X,Y,Z.kenngr.messachse=1: exit 0
; page 15556660363 measuring with the main axes (type 4)
; note K-0133 at 8:5
; end X7 Y10
N10 G00 X0 Y0 Z0
N20 X5
N25 #MEAS MODE[4]
N30 G100 X10 Y10 F500
N40 G01 X7
N50 M30
