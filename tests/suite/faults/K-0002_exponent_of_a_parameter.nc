; run: exit 1
; error K-0002 at 3:5
P1=1e3
M30
