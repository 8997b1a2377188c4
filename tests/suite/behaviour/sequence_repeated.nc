; run: exit 0
; end X4 Y4 Z0
(three passes in all)
G91 F1000
N10 G01 X1
N20 Y1
L SEQUENCE [N10 N20 REPEAT=3]
M30
