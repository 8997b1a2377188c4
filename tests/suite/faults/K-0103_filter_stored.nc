; check --set X.filter_fir.type=1 --set Y.filter_fir.type=1 --set Z.filter_fir.type=1: exit 0
; note K-0103 at 3:1
#FILTER [ORDER=20]
X1 F100
#FILTER ON
#FILTER [ORDER=10]
X2
M30
