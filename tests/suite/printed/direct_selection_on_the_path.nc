; check: exit 1
; page 987835915 direct selection on the path (G236)
; error K-0019 at 5:5
; error K-0019 at 6:11
N10 G236
N20 #TRC [G236_LIN=1]
N30 M30
