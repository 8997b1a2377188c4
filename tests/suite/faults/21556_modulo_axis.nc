; check --set Z.kenngr.achs_typ=ACHSTYP_ROTATOR --set Z.kenngr.achs_mode=0x4: exit 1
; error 21556 at 3:1
#CS ON [1,2,3]
M30
