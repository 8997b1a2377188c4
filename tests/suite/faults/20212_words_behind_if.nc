; check: exit 1
; error 20212 at 4:11
P1=1
$IF P1==1 X100
$ENDIF
M30
