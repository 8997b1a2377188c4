; run --max-time 0.286: exit 0
(286 cycles of 1 ms, although 0.286 / 0.001 is a little less as a floating-point number)
N10 G04 X0.286
M30
