; run: exit 0
; page 15427958411 weights of accelerations and ramp times (G130 to G133), HSC manual
; end X10
N10 G130 X50 Y75 Z75
N20 G132 X75 Y75 Z75
N30 G131 50
N40 G133 50
N50 G01 X10 F1000
M30
