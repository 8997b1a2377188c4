; run --set X.kenngr.achs_mode=65: exit 1
; error 20636 at 5:1
X50 F6000
G96 S100
G63 Z-10 F300 S200
M30
