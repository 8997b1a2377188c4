; check: exit 1
; error 20908 at 4:9
#VAR
V.P.A : FOO
#ENDVAR
M30
