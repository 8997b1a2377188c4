; check: exit 1
; error 20242 at 5:8
$SWITCH 5
$CASE 5
$BREAK X200
$ENDSWITCH
M30
