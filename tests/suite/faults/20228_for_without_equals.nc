; check: exit 1
; error 20228 at 3:12
$FOR V.P.N ,100,10
$ENDFOR
M30
