; run: exit 0
; page 15651573131 diagnosis 20007, right
; end Z10
N10 G63 Z10 F300 S17
N20 M30
