; check: exit 1
; error 21380 at 4:1
G63 Z-10 F100 S100
L CYCLE [NAME=called/cycle.cyc @P1=5]
M30
