; check: exit 1
; error 20847 at 6:9
#VAR
V.P.U : UNS08 = 255
#ENDVAR
V.P.U = V.P.U + 1
M30
