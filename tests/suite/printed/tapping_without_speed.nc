; check: exit 1
; page 15651573131 diagnosis 20007, wrong
; error 20007 at 4:1
N10 G63 Z10 F300 S0
N20 M30
