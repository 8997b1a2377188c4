; check: exit 0
; warning 22007 at 3:7
#TRC [STRETCH_FACTOR=10]
X1 F1000
M30
