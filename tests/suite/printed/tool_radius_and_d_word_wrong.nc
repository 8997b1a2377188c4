; check: exit 1
; page 250719627 diagnosis 20083, wrong
; error 20083 at 6:8
; warning K-0114 at 6:5
N10 G00 X0 Y0 Z0
N20 D1 V.G.WZ_AKT.R=3
N30 M30
