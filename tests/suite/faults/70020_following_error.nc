; run --set X.getriebe[0].slep_max=100 --set X.getriebe[0].slep_min=50 --set X.getriebe[0].slep_ueberw_typ=1: exit 1
; error 70020 at 3:1
N10 G01 X50 F30000
M30
