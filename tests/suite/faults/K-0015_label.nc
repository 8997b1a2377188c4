; check: exit 1
; error K-0015 at 3:10
X1 $GOTO N50 F1000
M30
