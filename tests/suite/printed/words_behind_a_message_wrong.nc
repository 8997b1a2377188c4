; check: exit 1
; page 251655307 diagnosis 20450, wrong
; error 20450 at 5:28
N10 G00 X0 Y0 Z0
N20 #MSG ["PROGRAMMSTART"] G74 X1 Y2 Z3
N1000 M30
