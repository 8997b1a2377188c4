; run: exit 0
; page 206266379 mirroring with axes (G351)
; end X-10 Y20 Z5
N10 G351 X-1 Y1 Z+1
N20 G01 X10 Y20 Z5 F1000
N30 M30
