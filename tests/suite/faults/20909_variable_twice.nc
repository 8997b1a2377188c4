; check: exit 1
; error 20909 at 7:1
#VAR
V.P.A=1
#ENDVAR
#VAR
V.P.A=2
#ENDVAR
M30
