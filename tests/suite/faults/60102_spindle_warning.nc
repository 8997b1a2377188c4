; run --set S.filter[0].enable=1 --set S.filter[0].order=3 --set S.filter[0].prototype=BUTTERWORTH --set S.filter[0].fg_f0=0.25: exit 0
; warning 60102 at -
M3 S12000
G04 20
M5
M30
