; check: exit 1
; error K-0008 at 3:5
G17 G18
M30
