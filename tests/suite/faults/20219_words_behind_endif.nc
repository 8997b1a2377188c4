; check: exit 1
; error 20219 at 4:8
$IF 0
$ENDIF G01 X100 F1000
M30
