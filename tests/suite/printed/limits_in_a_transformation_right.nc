; run --identity-trafo: exit 0
; page 252160139 diagnosis 20664, right
; warning K-0111 at 7:5
; warning K-0111 at 8:5
; end X0 Y0 Z0
N10 G00 X0 Y0 Z0
N20 #KIN ID[1]
N30 #TRAFO ON
N100 #TRAFO OFF
N110 G98 X-500 Y-500
N1000 M30
