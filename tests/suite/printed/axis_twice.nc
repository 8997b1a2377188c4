; check: exit 1
; page 251085195 diagnosis 20203, wrong
; error 20203 at 5:13
N10 G00 X0 Y0 Z0
N20 X10 Y20 X10
N30 M30
