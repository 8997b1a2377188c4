; run --set X.kenngr.swe_neg=-200000 --set X.vorsteuer.vs_v_faktor=12 --set X.vorsteuer.vs_v_nenner=10: exit 1
; error 70022 at 4:1
G135
G01 X-20 F6000
M30
