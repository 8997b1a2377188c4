; check: exit 1
; error K-0012 at 3:1
"NAME" F1000
M30
