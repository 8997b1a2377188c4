; run: exit 0
; page 254945419 diagnosis 21501, right
; end X0 Y0
% main
N10 G00 X0 Y0 Z0
N20 P1=0
N30 $IF P1 == 1
N40 Y100
N100 X100
N105 $ENDIF
N150 M30
