; check -m ../../tests/suite/machines/grinding: exit 1
; page 254471051 diagnosis 21389, wrong
; error 21389 at 8:5
N05 G01 X100 F10000
N08 D1
N10 #OTC ON
N12 G01 X150
N15 #OTC [LENGTH CONT WEAR_CONST_TOOL]
N20 G01 X200
N900 #OTC OFF
N1000 M30
