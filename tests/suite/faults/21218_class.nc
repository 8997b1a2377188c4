; check: exit 1
; error 21218 at 4:1
#VAR
V.G.A = 1
#ENDVAR
M30
