; check --set Z.kenngr.achs_typ=ACHSTYP_ROTATOR --set Z.kenngr.achs_mode=0x4: exit 1
; error 20958 at 4:9
G90 G01 F1000 Z10
G91 G01 Z--200
M30
