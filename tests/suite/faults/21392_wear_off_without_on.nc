; check: exit 1
; error 21392 at 4:1
G01 X100 F10000
#OTC OFF
M30
