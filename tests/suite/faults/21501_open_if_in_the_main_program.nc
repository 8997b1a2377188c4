; check: exit 1
; error 21501 at 3:1
$IF 0
X1
M30
