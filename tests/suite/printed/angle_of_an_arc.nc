; check: exit 1
; page 1097604107 diagnosis 22253, wrong
; error 22253 at 5:9
N10 G00 X2 Y20 F500
N20 G02 X10 Y0 I0 J-20 #CANG=90
N30 M30
