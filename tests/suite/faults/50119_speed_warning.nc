; run --set X.filter[0].enable=1 --set X.filter[0].order=3 --set X.filter[0].prototype=BUTTERWORTH --set X.filter[0].fg_f0=2 --start X-490: exit 0
; warning 50119 at 4:1
; warning K-0112 at -
N10 G00 X490
M30
