; run: exit 0
; page 251032971 diagnosis 20186, right
#VAR
V.L.POS1
#ENDVAR
N10 #GET CMDPOS [V.L.POS1=X ]
N20 M30
