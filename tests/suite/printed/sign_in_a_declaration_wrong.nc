; check: exit 1
; page 252934795 diagnosis 20904, wrong
; error 20904 at 5:15
#VAR
V.L.Test[2]=[1;2]
#ENDVAR
N10 M30
