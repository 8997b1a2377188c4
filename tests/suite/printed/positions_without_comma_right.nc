; run: exit 0
; page 251032971 diagnosis 20186, right
N10 #GET CMDPOS [P1=X, P2=Y]
N20 M30
