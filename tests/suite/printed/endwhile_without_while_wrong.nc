; check: exit 1
; page 251224459 diagnosis 20237, wrong
; error 20237 at 5:5
N10 G00 X0 Y0 Z0 P1=1
N20 $ENDWHILE
N30 M30
