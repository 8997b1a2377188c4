; run --set channel.mode_exact_stop_indp_axis=1: exit 0
; page 149561227 synchronisation of independent axes, second example
; end X10 Y10 Z500
N10 G00 G90 X0 Y0 Z0
N20 Z[INDP_ASYN POS=500 G0 G90]
N30 G01 G90 X10 Y10 Z500 G60 F3000
M30
