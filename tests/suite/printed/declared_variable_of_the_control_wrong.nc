; check: exit 1
; page 252952203 diagnosis 20908, wrong
; error 20908 at 5:1
#VAR
V.G.NEW = 1
#ENDVAR
M30
