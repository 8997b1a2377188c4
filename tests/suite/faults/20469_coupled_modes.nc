; check --set X.kenngr.achs_typ=ACHSTYP_ROTATOR --set Z.kenngr.achs_typ=ACHSTYP_ROTATOR --set Z.kenngr.achs_mode=0x4: exit 1
; error 20469 at 5:1
#SET AX [X,1,0][Y,2,1][C,3,3]
#SET AX LINK [1, C=X]
#ENABLE AX LINK [1]
M30
