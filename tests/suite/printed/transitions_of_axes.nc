; check: exit 1
; page 206736907 transitions of single axes (G116)
; error K-0019 at 5:5
N10 G01 F1000
N20 G116 X1 Y1
N30 X10
N40 G117
N50 M30
