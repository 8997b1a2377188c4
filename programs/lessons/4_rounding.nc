%rounding
(lesson 4: the corner of lesson 3, rounded within V.E.DEV mm)
N10 #SLOPE [TYPE=HSC]
N20 #CONTOUR MODE [DEV PATH_DEV=V.E.DEV]
N30 G01 X20 F6000 G261
N40 Y20 G260
N50 M30
