; check -m ../../tests/suite/machines/grinding: exit 1
; error 21389 at 6:1
F10000
D1
#OTC ON
#OTC [WEAR_CONST=1]
G01 X20
#OTC OFF
M30
