; run: exit 0
; warning K-0075 at 3:21
#MACHINE DATA [AX=X AXPARAM="kenngr.achs_typ ACHSTYP_ROTATOR"]
M30
