; run: exit 0
; page 251041675 diagnosis 20188, right
N10 G00 X0 Y0 Z0
N20 R1=10
N1000 M30
