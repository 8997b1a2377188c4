; run: exit 1
; error K-0008 at 3:11
$GOTO N10 $GOTO N20
N10:
N20:
M30
