; check: exit 1
; error 21216 at 6:6
#VAR
V.P.TAB[3] = [1, 2, 3]
#ENDVAR
P1 = V.P.TAB
M30
