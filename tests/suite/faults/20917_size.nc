; check: exit 1
; error 20917 at 4:8
#VAR
V.P.TAB[5000000]
#ENDVAR
M30
