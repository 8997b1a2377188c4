; run: exit 1
; error K-0002 at 3:1
$IFP1==1
X1 F1000
$ENDIF
M30
