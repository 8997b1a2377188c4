; check: exit 1
; error 21385 at 3:1
@S=1000
M30
