; check: exit 1
; error 20974 at 4:1
#VAR
V.P.TAB[2][2][2][2][2]
#ENDVAR
M30
