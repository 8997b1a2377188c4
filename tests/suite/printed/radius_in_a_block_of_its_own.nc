; run: exit 0
; page 15556764811 radius in a block of its own
; warning K-0109 at 7:9
; passes X50 Y50
; end X100 Y0
N10 G90 G01 X0 Y0 F5000
N20 G02 R=50
N30 X100
N40 M30
