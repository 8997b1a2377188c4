; check: exit 1
; error 20908 at 4:1
#VAR
V.G.A = 1
#ENDVAR
M30
