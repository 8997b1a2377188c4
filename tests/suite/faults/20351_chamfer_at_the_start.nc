; check: exit 0
; warning 20351 at 3:1
G301 I1
X10 F1000
M30
