; run --set channel.mode_implicite_sync_indp_asyn_axis=1: exit 0
; page 502430091 synchronisation by a block that names the axis (P-CHAN-00451)
; end X50 Y30
; passes X50 Y20
N10 G0 X0 Y0 Z0
N20 G1 G90 Y10 F5000
N30 X[INDP_ASYN G90 POS50 G01 FEED 300]
N40 Y20
N50 X50
N60 Y30
M30
