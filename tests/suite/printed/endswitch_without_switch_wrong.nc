; check: exit 1
; page 251172235 diagnosis 20225, wrong
; error 20225 at 6:5
N10 G00 X0 Y0 Z0
N20 P1=5
N30 $ENDSWITCH
N1000 M30
