; check: exit 1
; error 21460 at 7:9
; error 21460 at 8:14
#VAR
V.P.S : STRING[10]
#ENDVAR
V.P.S = 100 + 10
V.P.S = LEFT[5, 1]
M30
