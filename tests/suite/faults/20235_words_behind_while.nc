; check: exit 1
; error 20235 at 3:13
$WHILE P1>0 X100
$ENDWHILE
M30
