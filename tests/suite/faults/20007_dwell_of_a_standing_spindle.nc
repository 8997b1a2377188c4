; check: exit 1
; error 20007 at 3:5
G04 S10
M30
