; check: exit 1
; page 252373387 diagnosis 20739, wrong
; error 20739 at 6:5
; warning K-0114 at 6:32
; error 20008 at 6:24
N10 V.G.WZ_AKT.V[1]=40 X10 Y20 D1
N20 M30
