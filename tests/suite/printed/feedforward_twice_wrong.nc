; check: exit 1
; page 255863691 diagnosis 21738, wrong
; error 21738 at 4:25
N10 S[G136=90 M03 S1000 G136=0]
N1000 M30
