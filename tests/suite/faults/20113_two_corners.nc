; check: exit 1
; error 20113 at 3:5
G25 G26
M30
