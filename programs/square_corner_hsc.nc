; The square of square_corner.nc through the HSC mean filter (order 20: a delay of 10 ms), then without it.
; The machine must have the filter: kontur run square_corner_hsc.nc -m machines/xyz_hsc
%SQUARE_CORNER_HSC
N10 G71 G90 G17 G00 X0 Y0
N20 #FILTER ON [HSC]
N30 G01 X1 F4000
N40 Y1
N50 X0
N60 Y0
N70 #FILTER OFF [HSC]
N80 X1
N90 Y1
N100 X0
N110 Y0
N120 M30
