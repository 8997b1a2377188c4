; run: exit 0
; end X2 Y2 Z0
(a whole $IF is inside)
G91 F1000
N10 $IF 1 == 1
X1
$ENDIF
N20 Y1
L SEQUENCE [N10 N20]
M30
