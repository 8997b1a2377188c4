; run: exit 0
; end X10 Y0
; passes X55 Y60
; passes X35 Y60
; passes X20 Y60
; passes X12.928932188 Y2.928932188
(a contour at half its size: its corners, the middle of its arcs, and the zero point that G92 has moved)
%L CONT
N01 G01 G90 F6000
N02 X90 Y0
N04 X90 Y120
N06 X50 Y120
N07 X50 Y100
N08 X40 Y100
N09 G03 X0 Y100 I-20 J0
N10 G01 X0 Y20
N11 G03 X20 Y0 R20
M17
%MAIN
N15 G92 X10
N20 G00 X0 Y0
N30 #SCALE ON X0.5 Y0.5
N40 LL CONT
N50 #SCALE OFF
N60 X0 Y0
M30
