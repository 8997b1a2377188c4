; check -m two_spindles: exit 1
; error 60154 at 5:1
G01 F1000 X0
S1000
G33 Z-20 K1
M30
