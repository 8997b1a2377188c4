; check: exit 1
; page 251524747 diagnosis 20400, wrong
; error 20400 at 5:5
N10 G00 X0 Y0 Z0
N20 P0=10
N1000 M30
