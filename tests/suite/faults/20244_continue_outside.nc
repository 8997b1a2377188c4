; check: exit 1
; error 20244 at 3:1
$CONTINUE
M30
