; check --set Z.kenngr.achs_typ=ACHSTYP_ROTATOR --set Z.kenngr.achs_mode=0x4: exit 1
; error 21555 at 4:1
G18
G41
M30
