; run: exit 1
; error K-0008 at 3:11
M30 $GOTO N5
N5: M30
