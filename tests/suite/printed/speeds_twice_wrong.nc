; check: exit 1
; page 251019915 diagnosis 20181, wrong
; error 20181 at 5:30
N10 G00 X0 Y0 Z0
N20 S1000 M03 X100 G01 F2000 S1500
N30 M30
