; run: exit 0
; warning 120567 at 4:1
; warning K-0101 at 4:1
G61 X10 F1000
#FGROUP [X]
X20 Y10
M30
