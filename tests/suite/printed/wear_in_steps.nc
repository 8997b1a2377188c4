; run -m ../../tests/suite/machines/grinding: exit 0
; page 213664139 online tool compensation (#OTC) with values of the PLC
N20 G17 G90
N22 D1 G25
N40 G1 X0 Y0 Z0 F600
N50 #OTC ON [RADIUS DISC]
N55 G42
N60 G1 X2
N70 G1 X102
N80 G26 Y100
N90 X2
N95 Y0
N100 G40 G1 X0
N110 #OTC OFF
N120 M30
