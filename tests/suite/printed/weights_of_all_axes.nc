; run: exit 0
; page 15427958411 weights of all axes
; end X10 Y10
N10 G131 50
N20 G133 50
N30 G01 X10 Y10 F2000
N40 M30
