; check: exit 1
; error 20711 at 4:7
G01 F1000 X100
#PSET X-214748
M30
