; check: exit 1
; page 251059083 diagnosis 20194, wrong
; error 20194 at 5:5
N10 G00 X0 Y0 Z0
N20 V.G.T_AKT
N1000 M30
