; run --set X.filter_fir.type=1 --set X.filter_fir.order=20 --set X.filter[0].prototype=HSC --set X.filter[0].type=8 --set X.filter[0].order=30: exit 0
; warning K-0112 at 5:1
; warning K-0149 at 7:1
; warning K-0112 at 7:1
#FILTER ON
G01 X1 F1000
#FILTER ON [HSC]
X2
M30
