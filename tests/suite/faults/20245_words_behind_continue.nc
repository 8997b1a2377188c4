; check: exit 1
; error 20245 at 4:11
$FOR P1=1,3,1
$CONTINUE X100
$ENDFOR
M30
