; run --set X.kenngr.achs_mode=65: exit 1
; error 20122 at 4:10
X50 F6000
G96 S100 G97
M30
