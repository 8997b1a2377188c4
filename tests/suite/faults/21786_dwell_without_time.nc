; check: exit 1
; error 21786 at 3:1
G04
M30
