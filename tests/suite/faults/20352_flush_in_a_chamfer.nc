; check: exit 0
; warning 20352 at 4:1
X10 F1000
G301 I1
#FLUSH
Y10
M30
