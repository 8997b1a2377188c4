; check: exit 1
; page 254945419 diagnosis 21501, wrong
; error 21501 at 7:5
% main
N10 G00 X0 Y0 Z0
N20 P1=0
N30 $IF P1 == 1
N40 Y100
N100 X100
N150 M30
