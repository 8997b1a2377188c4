; check: exit 1
; page 987835915 insertion at direct selection (G236_LIN)
; error K-0019 at 4:11
N10 #TRC [G236_LIN=1]
N20 M30
