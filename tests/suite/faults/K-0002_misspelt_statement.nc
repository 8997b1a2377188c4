; run: exit 1
; error K-0002 at 6:1
P1=0
$WHILE P1<3
P1=P1+1
$EDWHILE
M30
