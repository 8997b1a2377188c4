; check -m ../../tests/suite/machines/grinding: exit 1
; page 254475403 diagnosis 21390, wrong
; error 21390 at 8:5
N05 G01 X100 F10000
N08 D1
N10 #OTC ON [LENGTH CONT WEAR_CONST_TOOL]
N20 G01 X200
N30 #OTC ON
N900 #OTC OFF
N1000 M30
