; check: exit 1
; error 21480 at 3:7
$GOTO [INSIDE]
$FOR P1=1,2,1
[INSIDE] X1 F1000
$ENDFOR
M30
