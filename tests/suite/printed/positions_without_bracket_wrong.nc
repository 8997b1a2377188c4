; check: exit 1
; page 251032971 diagnosis 20186, wrong
; error 20186 at 4:34
N10 #GET CMDPOS [P1=X, P2=Y, P3=Z
N20 M30
