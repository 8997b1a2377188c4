; run: exit 0
; end X2 Y1 Z0
(N10 comes before the call: N10 is the end)
G91 F1000
N10 G01 X1
N20 Y1
L SEQUENCE [N10 N10 ENDTAG]
M30
