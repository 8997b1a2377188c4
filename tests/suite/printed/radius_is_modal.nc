; run: exit 0
; page 15556764811 radius programming
; passes X50 Y50
; passes X150 Y-50
; end X200 Y0
N10 G90 G01 X0 Y0 F5000
N20 G02 X100 R50
N30 G03 X200 R50
N40 M30
