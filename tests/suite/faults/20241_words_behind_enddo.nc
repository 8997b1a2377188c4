; check: exit 1
; error 20241 at 4:10
$DO
$ENDDO 0 X100
M30
