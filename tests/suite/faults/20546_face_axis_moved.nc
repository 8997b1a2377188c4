; check --set X.kenngr.achs_mode=65 --set X.kenngr.durchm_prog_abs=1: exit 1
; error 20546 at 4:1
G18 G51
#SET AX [X,1,1][Y,2,0][Z,3,2]
M30
