; check --set Z.kenngr.achs_typ=2 --set Z.kenngr.achs_mode=4 --set Z.getriebe[0].moduloo=-10: exit 0
; warning 110052 at --set 1:1
M30
