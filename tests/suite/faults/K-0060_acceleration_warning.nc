; run --set X.filter[0].enable=1 --set X.filter[0].order=6 --set X.filter[0].prototype=BUTTERWORTH --set X.filter[0].fg_f0=10 --set X.kenngr.dyn_monitoring_a_warn=50: exit 0
; warning K-0060 at 6:1
; warning K-0060 at 6:1
; warning K-0112 at -
N10 G131=170
N20 G01 X100 F60000
M30
