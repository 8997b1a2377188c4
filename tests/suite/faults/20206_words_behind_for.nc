; check: exit 1
; error 20206 at 3:19
$FOR P10=0, 20, 1 G01 X10
$ENDFOR
M30
