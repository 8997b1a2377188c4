; check: exit 1
; error 20227 at 3:6
$FOR COUNT=1,2,1
$ENDFOR
M30
