; check: exit 1
; error 20216 at 3:1
$ELSEIF 1
M30
