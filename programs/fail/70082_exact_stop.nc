; The axis is not in its window in time: error 70082. Needs a slow position controller:
; kontur run programs/fail/70082_exact_stop.nc --set X.getriebe[0].kv=1000 --set X.getriebe[0].window=10 --set X.getriebe[0].position_settling_time=20000
%FAIL_70082
N10 G71 G90 G60 G01 X50 F6000
N20 G60 X60
N30 M30
