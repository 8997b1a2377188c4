; check --set X.kenngr.achs_mode=0x10001 --set X.kenngr.gantry_ax_nr=2: exit 2
; error 110342 at --set 1:1
N10 G01 X1 Y1 F1000
N20 M30
