; run --set channel.enable_mod_axis_always_shortest_way=1 --set Z.kenngr.achs_typ=ACHSTYP_ROTATOR --set Z.kenngr.achs_mode=0x4: exit 0
; page 208549515 modulo axes, always the shortest way (P-CHAN-00346)
; passes X1 Y0 Z-160
; passes X2 Y0 Z0
; passes X3 Y0 Z-160
; passes X4 Y0 Z0
; passes X5 Y0 Z160
; passes X6 Y0 Z60
; passes X7 Y0 Z260
; end X8 Y0 Z60
N10 G90 G01 X0 Z0 F10000
N20 X1 Z200
N30 X2 Z0
N40 X3 Z+200
N50 X4 Z0
N60 X5 Z-200
N70 X6 Z60
N80 G91 X1 Z+200
N90 X1 Z-200
N100 M30
