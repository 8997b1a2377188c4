; check: exit 1
; error 20904 at 4:14
#VAR
V.L.TAB[2]=[1;2]
#ENDVAR
M30
