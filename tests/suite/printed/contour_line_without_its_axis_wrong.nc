; check: exit 1
; page 256503435 diagnosis 21907, wrong
; error 21907 at 6:6
N240 G18 G1 Z15 X2 F1000
N250 #PUT AX [Z]
N260 #ANG=30 X25
N270 M30
