; check --identity-trafo: exit 1
; page 252208011 diagnosis 20683, wrong
; warning K-0111 at 7:5
; warning K-0111 at 8:5
; error 20683 at 9:5
N10 G00 X0 Y0 Z0
N20 #KIN ID[1]
N30 #TRAFO ON
N40 #PUT AX[X]
N100 #TRAFO OFF
N1000 M30
