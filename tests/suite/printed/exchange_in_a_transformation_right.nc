; run --identity-trafo: exit 0
; page 252208011 diagnosis 20683, right
; warning K-0111 at 7:5
; warning K-0111 at 8:5
; end X0 Y0 Z0
N10 G00 X0 Y0 Z0
N20 #KIN ID[1]
N30 #TRAFO ON
N100 #TRAFO OFF
N110 #PUT AX[X]
N1000 M30
