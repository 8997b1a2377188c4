; check: exit 1
; error 20131 at 3:1
G81
M30
