; check: exit 1
; error 20918 at 6:16
#VAR
P20[3][4]
#ENDVAR
P1=SIZEOF[P20, 3]
M30
