; check: exit 1
; page 251015563 diagnosis 20180, wrong
; error 20180 at 5:5
N10 G00 X0 Y0 Z0
N20 SPDL=1000 M03
N1000 M30
