; run --set X.kenngr.achs_mode=65: exit 0
; warning 20633 at 5:5
M3 S100
X0.1 F100
G96 S100
G97
M30
