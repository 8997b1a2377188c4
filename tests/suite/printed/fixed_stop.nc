; run --set X,Y,Z.kenngr.messachse=1 --set X.kenngr.meas_signal_fixed_stop=1 --set X.kenngr.fixed_stop_pos_lag_limit=50000: exit 0
; page 206202891 measuring on a fixed stop (type 7)
; end X10 Y20
N10 G00 X0 Y0
N20 #MEAS [TYPE=7]
N30 G100 X10 Y20 F2000
N40 M30
