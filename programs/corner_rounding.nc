; A square of 20 mm at F3000, four times: what happens at its corners.
;   lines 8 to 11   G60: exact stop at every corner
;   lines 12 to 15  sharp corners without a stop, as fast as the axes allow
;   lines 17 to 20  contouring, at most 0.1 mm from the corner
;   lines 22 to 25  contouring from 1 mm before to 1 mm behind the corner
%CORNER_ROUNDING
N10 G71 G90 G17 G00 X0 Y0
N20 G60 G01 X20 F3000
N30 G60 Y20
N40 G60 X0
N50 G60 Y0
N60 X20
N70 Y20
N80 X0
N90 Y0
N100 #CONTOUR MODE ON [DEV PATH_DEV=0.1]
N110 X20
N120 Y20
N130 X0
N140 Y0
N150 #CONTOUR MODE [DIST PRE_DIST=1 POST_DIST=1]
N160 X20
N170 Y20
N180 X0
N190 G260 Y0
N200 M30
