; check: exit 1
; error 20214 at 3:1
$ELSE
M30
