; check: exit 1
; error 20237 at 3:1
$ENDWHILE
M30
