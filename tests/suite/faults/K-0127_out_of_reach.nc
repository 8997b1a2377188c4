; check: exit 1
; error K-0127 at 3:10
G1 F1000 #ANG=90 X20
M30
