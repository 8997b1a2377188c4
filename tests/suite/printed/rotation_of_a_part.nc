; run: exit 0
; page 15557032587 contour rotation, a part in three positions
; warning K-0101 at 22:6
; warning K-0109 at 24:6
; passes X125 Y0
; passes X20.606602 Y-52.027958
; passes X-20.606602 Y-52.027958
; end X67.781746 Y36.360390
%L part
N10 G0 G90 X0 Y0
N30 G1 F5000 Y50
N40 X75
N50 G2 Y-50 R50
N60 G1 X0
N70 Y0
N80 M29
%ang1.nc
N100 G53 G17
N110 LL part
N130 #ROTATION ON [ANGLE -45 CENTER1=10 CENTER2=100]
N140 LL part
N150 G21 (mirroring of X coordinates)
N160 LL part
N170 G18 (warning expected)
M30
