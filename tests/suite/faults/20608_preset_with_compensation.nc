; check: exit 1
; warning K-0114 at 4:1
; error 20608 at 5:1
G41 X100 F1000
#PSET X200
G40 X0
M30
