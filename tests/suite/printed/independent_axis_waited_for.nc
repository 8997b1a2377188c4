; run: exit 0
; page 149561227 synchronisation of independent axes, first example
; passes X0 Y0 Z500
; end X10 Y10 Z500
N10 G00 G90 X0 Y0 Z0
N20 Z[INDP_ASYN POS=500 G0 G90]
N30 #WAIT INDP [Z]
N40 X10 Y10
M30
