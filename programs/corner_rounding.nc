; A corner of 90 degrees in X4.5 Y0, seven times at F3000; each pass stops exactly at X4.5 Y2 and at the start.
;   lines 11 to 13  G60: exact stop in the corner
;   lines 14 to 16  the sharp corner without a stop, as fast as the axes allow
;   lines 18 to 20  contouring DEV, 0.15 mm from the corner: the curve begins 0.566 mm before it
;   lines 22 to 24  contouring DIST, from 1 mm before to 1 mm after the corner: 0.265 mm from it
;   lines 26 to 28  contouring POS, through the point X4.35 Y0.15: 0.212 mm from the corner
;   lines 30 to 32  contouring PTP, at most 0.15 mm from the corner and from 0.4 mm before it: 0.106 mm
;   lines 35 to 37  B-spline, 0.1 mm from the corner: it begins 0.424 mm before it
%CORNER_ROUNDING
N10 G71 G90 G17 G00 X0 Y0
N20 G60 G01 X4.5 F3000
N30 G60 Y2
N40 G60 X0 Y0
N50 X4.5
N60 G60 Y2
N70 G60 X0 Y0
N80 #CONTOUR MODE ON [DEV PATH_DEV=0.15]
N90 X4.5
N100 G60 Y2
N110 G60 X0 Y0
N120 #CONTOUR MODE [DIST PRE_DIST=1 POST_DIST=1]
N130 X4.5
N140 G60 Y2
N150 G60 X0 Y0
N160 #CONTOUR MODE [POS PRE_DIST=1 POST_DIST=1 X=4.35 Y=0.15]
N170 X4.5
N180 G60 Y2
N190 G60 X0 Y0
N200 #CONTOUR MODE [PTP PATH_DEV=0.15 PATH_DIST=0.4]
N210 X4.5
N220 G60 Y2
N230 G60 X0 Y0
N240 #CONTOUR MODE OFF
N250 #HSC ON [BSPLINE PATH_DEV=0.1 AUTO_OFF_G60=1]
N260 X4.5
N270 G60 Y2
N280 G60 X0 Y0
N290 #HSC OFF
N300 M30
