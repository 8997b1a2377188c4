; check: exit 1
; error K-0120 at 3:1
t_s,line,block,X_ipo_mm
0.000000,1,,0.0000000
0.001000,1,,0.0001000
