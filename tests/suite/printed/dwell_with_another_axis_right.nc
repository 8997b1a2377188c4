; run: exit 0
; page 252216715 diagnosis 20685, right
; end X0 Y0 Z0
N10 G00 X0 Y0 Z0
N20 G04 X0.2
N30 M30
