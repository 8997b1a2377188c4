; check: exit 1
; error 20012 at 4:1
X10 F1000
G301
Y10
M30
