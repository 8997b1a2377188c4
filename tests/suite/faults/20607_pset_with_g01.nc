; run: exit 1
; error 20607 at 4:1
G00 X0 Y0 Z0
G01 F1000 #PSET X200
M30
