; check --set X.kenngr.achs_mode=65 --set X.kenngr.durchm_prog_abs=1: exit 1
; error 20610 at 4:1
G51 X100 F1000
#PSET X200
M30
