; check --set X.kenngr.achs_mode=65: exit 1
; error 120167 at 4:5
M3 S100
G96 S-5
M30
