; check: exit 1
; note K-0109 at 5:8
; error 60132 at 6:5
M3 S1000
G95 F1 S0
G01 X10
M30
