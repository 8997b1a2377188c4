; check: exit 1
; error 20792 at 3:6
G150 G151
M30
