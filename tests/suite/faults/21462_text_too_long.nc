; check: exit 1
; error 21462 at 6:9
#VAR
V.P.T : STRING[3]
#ENDVAR
V.P.T = "LONG"
M30
