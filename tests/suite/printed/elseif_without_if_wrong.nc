; check: exit 1
; page 251133067 diagnosis 20216, wrong
; error 20216 at 6:5
; error K-0002 at 6:12
N10 G00 X0 Y0 Z0
N20 $ELSEIF
N1000 M30
