; check: exit 1
; error 20838 at 3:7
$GOTO N99999999999
M30
