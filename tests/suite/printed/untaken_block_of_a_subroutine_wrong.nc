; check: exit 1
; page 254941067 diagnosis 21500, wrong
; error 21500 at 7:5
%L sub1
N10 G00 X0 Y0 Z0
N20 P1=0
N30 $IF P1 == 1
N40 Y100
N100 X100
N110 M29
%main
N10 X0 Y0 Z0
N20 LL sub1
N30 M30
