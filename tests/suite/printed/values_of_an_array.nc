; check: exit 1
; page 253134987 diagnosis 20972, wrong
; error 20972 at 4:24
N10 V.P.NEW_VAR_1[6]=[1,2,3,4,5,6]
N20 M30
