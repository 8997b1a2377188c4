; check --set Z.kenngr.achs_typ=ACHSTYP_ROTATOR: exit 1
; error 20468 at 5:1
#SET AX [X,1,0][Y,2,1][C,3,3]
#SET AX LINK [1, C=X]
#ENABLE AX LINK [1]
M30
