; check: exit 1
; error 20243 at 3:1
$BREAK
M30
