; run -m ../../tests/suite/machines/grinding: exit 0
; page 213664139 online tool compensation (#OTC), general example with the wheel of the list
; end X50 Y0
N10 F10000
N20 D1
N30 G0 X0 Y0 Z0
N40 #OTC [RADIUS, CONT]
N50 #OTC ON
N60 G41 G01 X50
N70 X400
N80 G40 X50
N90 #OTC OFF
N100 G00 X50
N199 M30
