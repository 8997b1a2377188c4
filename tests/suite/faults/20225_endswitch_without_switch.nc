; check: exit 1
; error 20225 at 3:1
$ENDSWITCH
M30
