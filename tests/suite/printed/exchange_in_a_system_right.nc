; run: exit 0
; page 252212363 diagnosis 20684, right
; end X0 Y0
N10 G00 X0 Y0 Z0
N20 #CS ON[10,20,0,0,0,45]
N100 #CS OFF
N110 #PUT AX[X]
N120 M30
