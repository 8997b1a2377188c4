; check: exit 1
; error 20217 at 4:11
$IF 0
$ELSEIF 1 X1
$ENDIF
M30
