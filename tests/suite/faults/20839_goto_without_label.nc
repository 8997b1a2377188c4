; check: exit 1
; error 20839 at 3:7
$GOTO 20
M30
