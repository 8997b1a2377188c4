; run --set X.kenngr.swe_pos=200000 --set X.vorsteuer.vs_v_faktor=12 --set X.vorsteuer.vs_v_nenner=10: exit 1
; error 70021 at 5:1
G135
G01 X5 F6000
X20
M30
