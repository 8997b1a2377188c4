; check: exit 0
; warning K-0109 at 3:15
#VIB GUARD ON (MODE=2 FREQ=40)
X1 F100
M30
