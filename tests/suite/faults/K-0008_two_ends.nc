; run: exit 1
; error K-0008 at 3:5
M17 M30
