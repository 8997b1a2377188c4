; check: exit 1
; error 20221 at 3:1
$CASE 47
M30
