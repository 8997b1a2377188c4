; check: exit 1
; error 21468 at 3:9
$REPEAT P1=P1+1
$UNTIL 1
M30
