; check: exit 1
; error 20229 at 3:11
$FOR P1=1 10,1
$ENDFOR
M30
