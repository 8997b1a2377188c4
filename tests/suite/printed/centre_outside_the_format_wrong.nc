; check: exit 1
; page 250558603 diagnosis 20020, wrong
; error 20020 at 5:9
N10   G00 X0 Y0 Z0
N20 G02 I94967596 F1000
N1000 M30
