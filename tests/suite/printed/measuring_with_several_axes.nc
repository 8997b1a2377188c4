; run --set X,Y,Z.kenngr.messachse=1: exit 0
; page 15556655755 measuring with several axes (type 1)
; note K-0133 at 7:5
; end X7 Y10
N10 G00 X0 Y0 Z0
N20 X5
N30 G100 X10 Y10 F500
N40 G01 X7
N50 M30
