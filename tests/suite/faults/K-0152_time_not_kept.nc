; run: exit 0
; warning K-0101 at 4:1
; warning K-0152 at 5:1
G93 G01 X10 F10 (in 10 s, but for the ramps)
X110 F0.2 (the ramps alone take longer)
M30
