; run: exit 0
; page 250532491 diagnosis 20013, right
; end X0 Y0 Z0
N10 G00 X0 Y0 Z0
N20 G04 0.1
N30 M30
