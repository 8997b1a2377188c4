; check: exit 1
; error 20919 at 5:1
#VAR
P20[3]
P20[3]
#ENDVAR
M30
