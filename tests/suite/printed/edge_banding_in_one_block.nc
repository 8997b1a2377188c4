; check: exit 1
; page 15556670091 edge banding in one block (G108)
; error K-0019 at 5:5
N10 X0 Y0
N20 G108
N30 G01 X90 Y90 F20
N40 M97 G01 X150 Y150 F8
N50 M30
