; check --set Y.kenngr.achs_mode=0x41: exit 1
; error 20642 at 5:3
G00 Y20
G96 S100
S[M19 POS90]
M30
