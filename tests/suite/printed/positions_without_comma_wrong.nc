; check: exit 1
; page 251032971 diagnosis 20186, wrong
; error 20186 at 4:17
N10 #GET CMDPOS [P1=X P2=Y]
N20 M30
