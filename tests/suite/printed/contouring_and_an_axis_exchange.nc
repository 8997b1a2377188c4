; run: exit 0
; page 15556726923 contouring before an axis is released
; end X100 Y50
; passes X50 Y50
; warning K-0101 at 7:17
N10 G01 X100 Y0 Z0 F1000
N20 G01 X50 Y50 G61
N30 #PUT AX [Z]
N40 G01 X100
N50 M30
