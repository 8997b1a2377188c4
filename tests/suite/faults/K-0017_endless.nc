; check --max-blocks 1000: exit 1
; error K-0017 at 3:1
$WHILE 1
$ENDWHILE
M30
