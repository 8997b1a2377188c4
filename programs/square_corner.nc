; A square of 1 mm at F4000, three times: how the Vibration Guard cuts corners, and how AX_DEV limits it.
;   lines 8 to 11   guard with a tolerance of 0.01 mm per axis
;   lines 13 to 16  guard alone: the corners are cut by much more than 0.01 mm
;   lines 18 to 21  no guard: the set position is the interpolated one
%SQUARE_CORNER
N10 G71 G90 G17 G00 X0 Y0
N20 #VIB GUARD ON [MODE=2 FREQ=40 AX_DEV=0.01]
N30 G01 X1 F4000
N40 Y1
N50 X0
N60 Y0
N70 #VIB GUARD ON
N80 X1
N90 Y1
N100 X0
N110 Y0
N120 #VIB GUARD OFF
N130 X1
N140 Y1
N150 X0
N160 Y0
N170 M30
