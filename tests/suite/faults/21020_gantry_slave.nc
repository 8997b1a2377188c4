; check --set Y.kenngr.achs_mode=0x20001 --set Y.kenngr.gantry_ax_nr=1: exit 2
; error 21020 at --set 1:1
N10 G01 X1 Y1 F1000
N20 M30
