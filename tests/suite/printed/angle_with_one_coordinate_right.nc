; run: exit 0
; page 256464267 diagnosis 21895, right
; end X20 Y20
N100 G17 X10 Y10 F1000
N110 #ANG=45 X20
M30
