; check --set Z.kenngr.achs_typ=ACHSTYP_ROTATOR --set Z.kenngr.achs_mode=0x200: exit 0
; warning 110565 at --set 1:1
; warning K-0075 at --set 1:1
M30
