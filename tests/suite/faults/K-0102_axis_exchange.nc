; check: exit 0
; warning K-0102 at 4:1
#VIB GUARD ON
#PUT AX [Z]
M30
