; run: exit 0
; end X6 Y3 Z0
(loops inside are left in order, and start again with every pass)
G91 F1000
N10 G01
$FOR P1=1,2,1
X1
$ENDFOR
N20 Y1
L SEQUENCE [N10 N20 REPEAT=2]
M30
