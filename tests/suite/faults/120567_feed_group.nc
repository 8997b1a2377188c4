; run: exit 0
; warning 120567 at 3:1
G61 X10 F1000
#FGROUP [X]
X20 Y10
M30
