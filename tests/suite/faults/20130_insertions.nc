; check: exit 1
; error 20130 at 4:9
X10 F1000
G301 I1 G302
Y10
M30
