; check: exit 1
; error 20834 at 4:1
G01 X1 F1000
N99999999999: X2
M30
