; check: exit 1
; error 20114 at 3:5
G40 G41
M30
