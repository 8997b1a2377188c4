; check: exit 1
; error 20904 at 5:1
#VAR
V.P.A : UNS32 = 5
G01 X1 F100
X2
X3
M30
