; run: exit 0
; page 15556778635 weights of ramp times, older page (G132, G133, G134)
; end X10
N10 G132 X200
N20 G133 = 50
N30 G134 = 80
N40 G01 X10 F1000
M30
