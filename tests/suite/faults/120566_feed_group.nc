; run: exit 0
; warning 120566 at 3:1
G261 X10 F1000
#FGROUP [X]
X20 Y10
G260
M30
