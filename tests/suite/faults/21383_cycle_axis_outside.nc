; check: exit 1
; error 21383 at 3:1
@X=10
M30
