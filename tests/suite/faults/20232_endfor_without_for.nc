; check: exit 1
; error 20232 at 3:1
$ENDFOR
M30
