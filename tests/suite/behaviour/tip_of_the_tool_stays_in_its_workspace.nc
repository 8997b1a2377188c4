; run: exit 0
; end X0 Y0 Z65
; passes X30 Y0 Z70
(the tip of the tool is watched: with 20 mm of length the axis may go 20 mm higher than the area)
N10 #CONTROL AREA BEGIN [ID=1 WORK CIRC MIN_EXCUR=-20 MAX_EXCUR=50]
N20 G00 X30 Y0
N30 G02 X30 Y0 I-30 J0 F4000
N40 #CONTROL AREA END
N50 V.G.WZ[3].L = 20  V.G.WZ[3].OK = 1
N60 D3
N70 #CONTROL AREA ON ALL
N80 G01 X30 Z50
N90 X0 Z45
N100 M30
