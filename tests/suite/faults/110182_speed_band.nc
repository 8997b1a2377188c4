; check --set S.kenngr.vb_prozent=0: exit 0
; warning 110182 at --set 1:1
M30
