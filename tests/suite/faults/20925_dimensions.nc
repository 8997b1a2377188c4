; check: exit 1
; error 20925 at 6:4
#VAR
P20[3][4]
#ENDVAR
P1=P20[1]
M30
