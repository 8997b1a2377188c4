; run: exit 0
; page 206573067 weights of the maximum velocity (G127, G128)
; end X10 Y10
N10 G127 X70 Y60
N20 G128 = 100
N30 G01 X10 Y10 F1000
M30
