; check --set Y.kenngr.achs_mode=0x41: exit 1
; page 252090507 diagnosis 20642, wrong
; error 20642 at 6:5
N10 G00 Y20
N20 G96 S100 M3
N30 M19 S.POS=90
M30
