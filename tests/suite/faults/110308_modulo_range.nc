; check --set Z.kenngr.achs_typ=2 --set Z.kenngr.achs_mode=4 --set Z.getriebe[0].moduloo=2147483647 --set Z.getriebe[0].modulou=-1: exit 0
; warning 110308 at --set 1:1
; warning 110308 at --set 1:1
M30
