; check: exit 1
; page 252660619 diagnosis 20820, number outside the range
; error 20820 at 5:14
N10 G00 X0 Y0 Z0
N20 #CS DEF [0][1,2,3,0,0,0]
N30 M30
