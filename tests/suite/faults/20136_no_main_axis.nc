; check: exit 1
; error 20136 at 4:1
#PUT AX [X]
G41
M30
