; check: exit 1
; page 256464267 diagnosis 21895, wrong
; error 21895 at 5:6
N100 G17 X10 Y10 F1000
N110 #ANG=45 X20 Y25
M30
