; check: exit 1
; error 21460 at 6:9
#VAR
V.P.S : STRING[10]
#ENDVAR
V.P.S = 100 + 10
M30
