; check: exit 1
; error 20187 at 3:1
R-1=10
M30
