; run: exit 0
; page 502430091 synchronisation by programming the axis again
; end X50 Y30
N10 G0 X0 Y0 Z0
N20 G1 G90 Y10 F5000
N30 X[INDP_ASYN G90 POS50 G01 FEED 3000]
N40 Y20
N50 X50
N60 Y30
M30
