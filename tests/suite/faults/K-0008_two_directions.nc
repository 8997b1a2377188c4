; check: exit 1
; error K-0008 at 3:10
S1000 M3 M4
M30
