; check: exit 0
; warning K-0101 at 4:8
; filament length of 3D printers
G01 X1 E0.5 F100
X2 E1.0
M30
