; check -m ../../tests/suite/machines/grinding: exit 1
; page 254484107 diagnosis 21392, wrong
; error 21392 at 7:6
N05 G01 X100 F10000
N10 D1
N20 G01 X200
N900 #OTC OFF
N1000 M30
