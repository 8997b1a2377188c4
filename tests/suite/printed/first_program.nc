; run: exit 0
; page 15556621963 first program: rapid and linear motions, spindle
; passes X100 Y100 Z50
; end X200 Y200 Z200
% 100 (program example)
N10 G00 X100 Y100 (rapid)
N20 Z100 (still rapid)
N30 G1 Z50 F5000 S1000 M3
N40 Z100
N50 G0 X200 Y200 Z200
N50 M5 (spindle stop)
N60 M30
