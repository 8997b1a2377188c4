; check: exit 1
; error 20188 at 3:1
R2=10
M30
