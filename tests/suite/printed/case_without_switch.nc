; check: exit 1
; page 251154827 diagnosis 20221, wrong
; error 20221 at 5:5
N10 G00 X0 Y0 Z0 P1=47
N20 $CASE P1
N30 M30
