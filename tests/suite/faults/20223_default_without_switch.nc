; check: exit 1
; error 20223 at 3:1
$DEFAULT
M30
