; check: exit 0
; note K-0109 at 3:1
M3
M30
