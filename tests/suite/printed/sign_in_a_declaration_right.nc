; run: exit 0
; page 252934795 diagnosis 20904, right
#VAR
V.L.Test[2]=[1,2]
#ENDVAR
N10 M30
