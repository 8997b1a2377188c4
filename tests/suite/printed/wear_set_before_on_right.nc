; run -m ../../tests/suite/machines/grinding: exit 0
; page 254471051 diagnosis 21389, right
; end X200 Y0
N05 G01 X100 F10000
N08 D1
N10 #OTC [LENGTH CONT WEAR_CONST_TOOL]
N15 #OTC ON
N20 G01 X200
N900 #OTC OFF
N1000 M30
