; check -m gantry --set X.kenngr.achs_mode=0x1: exit 0
; warning 70124 at --set 1:1
N10 G01 X1 Y1 F1000
N20 M30
