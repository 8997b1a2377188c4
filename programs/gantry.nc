; A bridge with two drives (machine gantry): X2 takes the set positions of X, each has its own controller and
; drive. Trace columns X_lag_mm and X2_lag_mm.
;   N20  equal drives: both 2 mm behind (100 mm/s, Kv 50/s), the bridge stays square
;   N40  G135: the lag of both is gone
; With a softer controller at the second drive the bridge racks in N20: --set X2.getriebe[0].kv=4000 leaves X2 2.5 mm
; behind, half a millimetre more than X; in N40 it is square again.
%GANTRY
N10 G71 G90 G00 X0 Y0
N20 G01 X120 Y50 F6500     (X with 6000 mm/min)
N30 G135
N35 G04 0.2
N40 X0 Y0
N50 M30
