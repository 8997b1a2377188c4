; check --set X,Y.kenngr.achs_mode=0x204 --set X,Y.kenngr.achs_typ=2: exit 1
; warning K-0075 at --set 1:1
; warning K-0075 at --set 1:1
; error 20885 at 5:1
#FACE [X, Y]
M30
