; check: exit 1
; error 20966 at 4:8
#VAR
V.P.TAB[0]
#ENDVAR
M30
