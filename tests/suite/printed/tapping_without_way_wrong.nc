; check: exit 1
; page 250593419 diagnosis 20032, wrong
; error 20032 at 4:9
N10 G63 Z0 F100 S100
N20 M30
