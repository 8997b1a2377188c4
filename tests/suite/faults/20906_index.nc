; check: exit 1
; error 20906 at 6:12
#VAR
V.P.TAB[2]
#ENDVAR
V.P.TAB[2]=5
M30
