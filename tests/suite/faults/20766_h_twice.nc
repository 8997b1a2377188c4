; check: exit 1
; error 20766 at 3:5
H10 H10
M30
