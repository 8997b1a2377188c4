; check --set X.kenngr.achs_mode=0x40 --set X.kenngr.durchm_prog_abs=1: exit 1
; error 20019 at 5:1
G51 G90 G01 F1000 X80
G351 X-1
X30
M30
