; run: exit 0
; page 251655307 diagnosis 20450, right
; note K-0081 at 6:1
; warning K-0111 at 7:5
N10 G00 X0 Y0 Z0
N20 #MSG ["PROGRAMMSTART"]
N30 G74 X1 Y2 Z3
N1000 M30
