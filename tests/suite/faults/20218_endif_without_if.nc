; check: exit 1
; error 20218 at 4:1
X100 F1000
$ENDIF
M30
