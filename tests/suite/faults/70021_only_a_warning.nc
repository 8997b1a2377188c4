; run --set X.kenngr.swe_pos=200000 --set X.kenngr.swe_behaviour=WARNING --set X.vorsteuer.vs_v_faktor=12 --set X.vorsteuer.vs_v_nenner=10: exit 0
; warning 70021 at 4:1
G135
G01 X20 F6000
M30
