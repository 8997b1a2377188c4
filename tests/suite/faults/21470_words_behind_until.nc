; check: exit 1
; error 21470 at 4:10
$REPEAT
$UNTIL 1 X100
M30
