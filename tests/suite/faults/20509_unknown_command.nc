; check: exit 1
; error 20509 at 3:5
N40 #FOO
M30
