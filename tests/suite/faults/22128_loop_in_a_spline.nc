; check: exit 1
; error 22128 at 7:1
G01 F500
G151
X1
X2 Y1
#RT WHILE
M30
