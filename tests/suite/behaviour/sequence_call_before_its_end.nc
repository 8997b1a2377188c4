; run: exit 0
; end X2 Y2 Z5
(N40 comes after the call: the call is the end)
G91 F1000
N10 G01 X1
N20 Y1
L SEQUENCE [N10 N40 ENDTAG]
N40 Z5
M30
