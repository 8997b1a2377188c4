; check -m ../../tests/suite/machines/grinding: exit 1
; error 21390 at 6:1
F10000
D1
#OTC ON
#OTC ON
G01 X20
#OTC OFF
M30
