; check: exit 1
; error K-0120 at 7:1
; of a slicer
M140 S60
M104 S200
M82
G28
G92 E0
G1 F2700 E-5
G1 X10 Y10 E0.5 F1500
