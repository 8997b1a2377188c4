; run: exit 0
; page 400184843 feed per revolution between other feeds (G95)
; end X20 Y200 Z0
; warning K-0101 at 8:5
N10 F1000 X100 M3 S1200
N20 G95 F1.5
N30 G94 X50
N40 G93 F20 X20
N50 G95 Y200 S2000
N60 M30
