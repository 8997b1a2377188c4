; check --identity-trafo: exit 1
; page 252160139 diagnosis 20664, wrong
; warning K-0111 at 7:5
; warning K-0111 at 8:5
; error 20664 at 9:5
N10 G00 X0 Y0 Z0
N20 #KIN ID[1]
N30 #TRAFO ON
N40 G98 X-500 Y-500
N100 #TRAFO OFF
N1000 M30
