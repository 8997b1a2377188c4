; One axis, the same move four times: what feedforward does to the following error (trace column X_lag_mm).
;   N30   off: v / Kv = 100 mm/s / (50/s) = 2 mm
;   N50   G135: no lag at constant speed
;   N70   G136 X80: one fifth remains, 0.4 mm
;   N90   G137, the weight stays stored: 2 mm again
%FEEDFORWARD_LAG
N10 G71 G90 G00 X0
N20 G137
N30 G01 X100 F6000
N40 G135
N45 G04 0.2
N50 G01 X0
N60 G136 X80
N65 G04 0.2
N70 G01 X100
N80 G137
N85 G04 0.2
N90 G01 X0
N95 G04 0.2
N100 M30
