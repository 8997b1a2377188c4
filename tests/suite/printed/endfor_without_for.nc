; check: exit 1
; page 251202699 diagnosis 20232, wrong
; error 20232 at 5:5
N10 G00 X0 Y0 Z0 P1=1
N20 $ENDFOR
N30 M30
