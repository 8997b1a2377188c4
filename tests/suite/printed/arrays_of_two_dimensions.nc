; run: exit 0
; page 15557118091 variables with two indices, over several lines
; end X22 Y35 Z0
#VAR
V.P.ARRAY_1[3][6] = [10,11,12,13,14,15, \
                     20,21,22,23,24,25, \
                     30,31,32,33,34,35 ]
V.L.MY_ARRAY[3][6] = [10,11,12,13,14,15, 20,21,22,23,24,25, 30,31,32,33,34,35]
V.P.VAR_1
V.L.VAR_1
V.S.VAR_1
#ENDVAR
N10 G00 XV.P.ARRAY_1[1][2] YV.L.MY_ARRAY[2][5]
N20 #DELETE V.P.ARRAY_1, V.L.MY_ARRAY, V.P.VAR_1, V.L.VAR_1, V.S.VAR_1
N30 Z[EXIST[V.P.VAR_1]]
N40 M30
