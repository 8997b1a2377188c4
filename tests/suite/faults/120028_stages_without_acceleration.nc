; check: exit 0
; warning 120028 at 5:1
; warning 120030 at 5:1
#SLOPE [TYPE=STEP]
G131=0
G131=100
G01 X1 F1000
M30
