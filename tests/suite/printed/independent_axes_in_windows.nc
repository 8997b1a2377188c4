; run --set channel.mode_exact_stop_indp_axis=2: exit 0
; page 149561227 synchronisation of independent axes, third example
; end X10 Y80 Z500
N10 G00 G90 X0 Y0 Z0
N20 Z[INDP_ASYN POS=500 G0 G90]
N25 Y[INDP_ASYN POS=80 G0 G90]
N30 #WAIT INDP [Z]
N40 X10
M30
