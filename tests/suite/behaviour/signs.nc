; run: exit 0
; end X0 Y-1 Z1
(SIGN of 0 is 0)
P1=0
G01 X5 Y5 Z5 F5000
X[SIGN[P1]] Y[SIGN[-3]] Z[SIGN[0.1]]
M30
