; check: exit 1
; page 250615179 diagnosis 20037, wrong
; error 20037 at 5:5
N10 G00 X0 Y0 Z0
N20 #ACHSE[X]
N30 M30
