; check: exit 1
; error 20127 at 3:6
G162 G162
M30
