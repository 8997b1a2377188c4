; run: exit 0
; page 1086442763 offsets in coordinate systems, the main axis of the example
; passes X151 Y51
; passes X372 Y72
; end X153 Y53
N10 X0 Y0 Z0 F6000
N100 #CS ON [50,50,0]
N110 G92 X100
N120 X1 Y1
N200 #CS ON [20,20,0]
N210 G92 X200
N220 X2 Y2
N300 #CS OFF
N310 X3 Y3
N320 M30
