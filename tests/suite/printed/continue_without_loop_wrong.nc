; check: exit 1
; page 251254923 diagnosis 20244, wrong
; error 20244 at 5:5
N10 G00 X0 Y0 Z0
N20 $CONTINUE
N1000 M30
