; check: exit 1
; page 251141771 diagnosis 20218, wrong
; error 20218 at 6:5
N10 G00 X0 Y0 Z0 P1=0
N20 G01 X100 F10000
N30 $ENDIF
N40 M30
