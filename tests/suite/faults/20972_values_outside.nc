; check: exit 1
; error 20972 at 3:24
N10 V.P.NEW_VAR_1[6]=[1,2,3,4,5,6]
N20 M30
