; check: exit 1
; page 251146123 diagnosis 20219, wrong
; error 20219 at 6:12
N10 G00 X0 Y0 Z0 P1=0
N20 $IF P1
N30 $ENDIF G01 X100 F10000
N40 M30
