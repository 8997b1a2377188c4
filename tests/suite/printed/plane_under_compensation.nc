; check: exit 1
; page 250893707 diagnosis 20133, wrong
; error 20133 at 7:5
N10 G00 X0 Y0 Z0
N20 V.G.WZ_AKT.R=1
N30 G41
N40 G19
N50 M30
