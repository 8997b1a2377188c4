; check: exit 1
; error 20239 at 3:5
$DO P1=P1+1
$ENDDO 0
M30
