; check: exit 1
; page 251041675 diagnosis 20188, wrong
; error 20188 at 5:5
N10 G00 X0 Y0 Z0
N20 R2=10
N1000 M30
