; check: exit 1
; page 981044875 diagnosis 22156, wrong
; error 22156 at 5:23
N10 G00 X0 Y0 Z0
N20 G68 R30 X150 Y200 Z100
N30 M30
