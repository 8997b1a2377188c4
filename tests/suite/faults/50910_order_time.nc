; check --set X.filter_fir.type=1 --set Y.filter_fir.type=1 --set Z.filter_fir.type=1: exit 0
; warning 50910 at 3:1
#FILTER ON [ORDER_TIME=10]
M30
