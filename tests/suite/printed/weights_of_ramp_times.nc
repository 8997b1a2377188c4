; run: exit 0
; page 15427958411 weights of accelerations and ramp times of axes
; end X10 Y10
N10 G130 X50 Y75 Z75
N20 G132 X75 Y75 Z75
N30 G01 X10 Y10 F2000
N40 M30
