; run: exit 0
; page 253000075 diagnosis 20921, right
; end X15
#VAR
P5[20][20]
#ENDVAR
N10 P5[10][10] = 15
N20 G01 XP5[10][10] F1000
N30 M30
