; check: exit 1
; page 251207051 diagnosis 20233, wrong
; error 20233 at 6:13
N10 G00 X0 Y0 Z0
N20 $FOR P1=1, 10, 2
N30 $ENDFOR G01 X100 F10000
N40 M30
