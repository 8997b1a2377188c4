; check: exit 1
; error K-0009 at 3:1
M70000
M30
