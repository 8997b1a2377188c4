; check: exit 0
; warning 20003 at 3:1
G160=2
M30
