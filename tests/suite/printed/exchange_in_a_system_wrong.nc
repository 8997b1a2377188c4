; check: exit 1
; page 252212363 diagnosis 20684, wrong
; error 20684 at 6:5
N10 G00 X0 Y0 Z0
N20 #CS ON[10,20,0,0,0,45]
N30 #PUT AX[X]
N40 M30
