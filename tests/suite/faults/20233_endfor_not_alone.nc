; check: exit 1
; error 20233 at 4:9
$FOR P1=1,2,1
$ENDFOR X1
M30
