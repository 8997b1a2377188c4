; check: exit 1
; error 21457 at 6:9
#VAR
V.P.S : STRING[10]
#ENDVAR
V.P.S = "Peter" + 23
M30
