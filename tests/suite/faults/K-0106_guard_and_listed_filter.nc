; check --set X.filter_fir.type=1: exit 1
; error K-0106 at 3:1
#VIB GUARD ON
M30
