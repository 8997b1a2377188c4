; run: exit 0
; end X2 Y4 Z7
(SIZEOF: the first dimension, a given one, and -1 for what is no array)
#VAR
P20[3][4]
V.P.A[7]
#ENDVAR
P1=2
G01 X[SIZEOF[P20]] Y[SIZEOF[P20, 2]] Z[SIZEOF[V.P.A]] F1000
G91 X[SIZEOF[P1]]
M30
