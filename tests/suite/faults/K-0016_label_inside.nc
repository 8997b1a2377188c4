; check: exit 1
; error K-0016 at 3:7
$GOTO N50
$IF 0
N50: X1 F1000
$ENDIF
M30
