; check: exit 1
; error 20238 at 4:11
$WHILE 0
$ENDWHILE X200
M30
