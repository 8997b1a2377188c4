; check: exit 0
; warning K-0101 at 4:1
; inverse time of other dialects
G93 X1 F2
X2 F2
M30
