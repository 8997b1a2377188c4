; check: exit 1
; page 15556731531 corner deceleration, older form
; error K-0019 at 5:5
N10 G01 G90 X10 Y10 F1000
N20 #SET CORNER PARAM [10, 1, 50]
N30 M30
