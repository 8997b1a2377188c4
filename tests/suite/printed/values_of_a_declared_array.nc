; run: exit 0
; page 253134987 diagnosis 20972, right
; end X6
#VAR
V.P.NEW_VAR_1[6]=[1,2,3,4,5,6]
#ENDVAR
N10 G01 XV.P.NEW_VAR_1[5] F1000
N20 M30
