; Two spindles at 1000 rpm (6000 deg/s, Kv 50/s): how feedforward reduces their lag
; (trace columns S_lag_deg and S2_lag_deg, machine two_spindles).
;   to 1.0 s   off: v / Kv = 6000 / 50 = 120 deg behind
;   to 1.5 s   S[G135]: none; S2 is still off
;   to 2.0 s   S2[G135 G136=90]: a tenth remains, 12 deg
;   to 2.5 s   S[G136=80]: a fifth remains, 24 deg
;   to 3.0 s   S[G137] and S2[G136=0]: both as at the beginning, S2 still selected
%SPINDLE_FEEDFORWARD
N10 G71 G90
N20 S1000 M3
N30 S2[REV1000 M3]
N40 G04 1
N50 S[G135]
N60 G04 0.5
N70 S2[G135 G136=90]
N80 G04 0.5
N90 S[G136=80]
N100 G04 0.5
N110 S[G137] S2[G136=0]
N120 G04 0.5
N130 M5 S2[M5]
N140 G04 1
N150 M30
