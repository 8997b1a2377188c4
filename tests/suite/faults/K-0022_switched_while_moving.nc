; run: exit 0
; warning K-0022 at 4:1
N10 X10 F1000
N20 G135 X20
M30
