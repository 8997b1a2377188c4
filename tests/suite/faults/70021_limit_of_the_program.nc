; run --set X.vorsteuer.vs_v_faktor=12 --set X.vorsteuer.vs_v_nenner=10: exit 1
; error 70021 at 6:1
G135 G01 X20 F6000
X0
G99 X20
X20
M30
