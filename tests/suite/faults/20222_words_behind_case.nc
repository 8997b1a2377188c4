; check: exit 1
; error 20222 at 4:9
$SWITCH 5
$CASE 5 X100
$BREAK
$ENDSWITCH
M30
