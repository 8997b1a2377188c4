; check: exit 1
; error 21382 at 3:1
@P1=10
M30
