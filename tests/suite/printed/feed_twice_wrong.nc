; check: exit 1
; page 250998155 diagnosis 20175, wrong
; error 20175 at 5:19
N10 G00 X0 Y0 Z0
N20 F100 G01 X100 F200
N30 M30
