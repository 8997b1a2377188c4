; run: exit 0
; note K-0133 at 5:1
; end X5
(of G310 the signal decides, of G100 the jump is one like any other)
G100 X5 F600 $GOTO N10
X7
N10: M30
