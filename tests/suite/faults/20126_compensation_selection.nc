; check: exit 1
; error 20126 at 3:6
G139 G138
M30
