; check: exit 1
; error 20583 at 3:1
G160=-1 X1
M30
