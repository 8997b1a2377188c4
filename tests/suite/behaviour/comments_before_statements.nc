; run: exit 0
; end X2 Y3
G01 F1000
(one) $IF 0
X1
(two (and a half)) $ELSE
X2
(three) (four) $ENDIF
Y3
M30
