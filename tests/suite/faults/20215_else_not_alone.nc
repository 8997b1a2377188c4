; check: exit 1
; error 20215 at 4:7
$IF 1
$ELSE X1
$ENDIF
M30
