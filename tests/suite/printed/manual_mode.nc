; check: exit 1
; page 250880651 diagnosis 20129, wrong
; error 20129 at 6:20
; warning K-0111 at 6:5
N10 G00 X0 Y0 Z0
N20 G201 #ACHSE[X] G200
N30 M30
