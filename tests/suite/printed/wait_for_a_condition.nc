; run --external EXT1=5 --external EXT2=TRUE: exit 0
; page 207058059 decoding waits for a condition (#WAIT FOR)
; end X200 Y0 Z0
N10 #WAIT FOR V.E.EXT1 == 5
N50 #WAIT FOR V.E.EXT2 == TRUE
N200 G01 X200 F1000
M30
