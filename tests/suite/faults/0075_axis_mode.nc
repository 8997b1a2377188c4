; check --set X.kenngr.achs_mode=0x401: exit 0
; warning K-0075 at --set 1:1
N10 G01 X1 F1000
N20 M30
