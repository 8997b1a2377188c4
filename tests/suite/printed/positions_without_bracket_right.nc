; run: exit 0
; page 251032971 diagnosis 20186, right
N10 #GET CMDPOS [P1=X, P2=Y, P3=Z]
N20 M30
