; run: exit 0
; page 15556731531 corner deceleration, older form, with another slope
; warning K-0100 at 9:1
; passes X50 Y10
; end X50 Y50
N10 G01 G90 X10 Y10 F1000
N20 #SET CORNER PARAM [10, 1, 50]
N30 G13
N40 X50
N50 Y50
N60 M30
