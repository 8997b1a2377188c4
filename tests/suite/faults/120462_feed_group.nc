; run: exit 0
; warning 120462 at 4:1
#FGROUP [X]
G02 X10 I5 F1000
M30
