; How long an axis may take to reach its exact-stop window. A soft controller (Kv 10/s, no feedforward) falls 10 mm behind
; at 100 mm/s and needs about half a second for the last millimetres: 10 mm exp(-Kv t) = 0.05 mm at t = 0.53 s.
;   N60  0.6 s are allowed: the axis arrives, then N70 begins
;   N90  0.2 s are allowed: error 70082 200 ms after the stop; the axis stops at once, the program is aborted (exit
;        code 1), N100 never begins
%EXACT_STOP_TIMEOUT
N10 G71 G90
N20 #SLOPE [TYPE=STEP]
N30 #MACHINE DATA [AX=X AXPARAM="getriebe[0].kv 1000"]                         (0.01/s)
N40 #MACHINE DATA [AX=X AXPARAM="getriebe[0].window 500"]                      (0.1 um: 0.05 mm)
N50 #MACHINE DATA [AX=X AXPARAM="getriebe[0].position_settling_time 600000"]   (us)
N60 G60 G01 X100 F6000
N70 Y20
N80 #MACHINE DATA [AX=X AXPARAM="getriebe[0].position_settling_time 200000"]
N90 G60 X0
N100 Y0
N110 M30
