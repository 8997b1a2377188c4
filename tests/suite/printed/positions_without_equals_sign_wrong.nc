; check: exit 1
; page 251032971 diagnosis 20186, wrong
; error 20186 at 8:17
; error 20186 at 8:18
#VAR
V.L.POS1
#ENDVAR
N10 #GET CMDPOS [V.L.POS1 X ]
N20 M30
