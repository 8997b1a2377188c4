; check: exit 0
; warning 20701 at 5:1
X10 F1000
G301 I1
G302 I1
Y10
M30
