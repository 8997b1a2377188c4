; run -m two_spindles: exit 0
; page 208221195 homing of spindles (G74)
; warning K-0111 at 4:7
N10 S[G74] S2[G74]
N20 M30
