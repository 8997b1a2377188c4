; check: exit 1
; error 20752 at 3:1
G04 -1
M30
