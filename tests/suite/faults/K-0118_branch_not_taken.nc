; check: exit 0
; warning K-0118 at 4:2
$IF 0
X!
$ENDIF
M30
