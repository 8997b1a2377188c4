; check: exit 1
; error 20981 at 4:1
#VAR
R20[3] = [40,41,42]
#ENDVAR
M30
