; run: exit 0
; end X5
(of G310 the signal decides, of G100 the jump is one like any other)
G100 X5 F600 $GOTO N10
X7
N10: M30
