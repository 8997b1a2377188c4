; check -m gantry --set X2.kenngr.achs_typ=ACHSTYP_ROTATOR --set X2.kenngr.achs_mode=0x20004: exit 0
; warning 70202 at --set 1:1
N10 G01 X1 Y1 F1000
N20 M30
