; check: exit 1
; page 250789259 diagnosis 20108, wrong
; error 20108 at 6:13
; error 20008 at 6:9
N10 G00 X0 Y0 Z0
N20 G01 X10 G00 Y20
N30 M30
