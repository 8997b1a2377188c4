; check: exit 1
; page 251163531 diagnosis 20223, wrong
; error 20223 at 5:5
N10 G00 X0 Y0 Z0
N20 $DEFAULT
N30 M30
