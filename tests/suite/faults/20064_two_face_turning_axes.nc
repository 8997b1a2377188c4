; check --set X,Y.kenngr.achs_mode=0x41: exit 1
; error 20064 at 4:1
; error 20064 at 5:5
G51
G96 S100
M30
