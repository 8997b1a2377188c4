; check --set Y.kenngr.achs_mode=0x41: exit 1
; error 20642 at 5:1
G00 Y20
G96 S100
M19 S.POS=90
M30
