; run --set Y.kenngr.achs_mode=0x41: exit 0
; warning K-0155 at 5:1
G00 X20 Y20
G96 S100 M3
G196 S2000
G01 Y15 F1000
M5
M30
