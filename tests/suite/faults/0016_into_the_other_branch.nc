; check: exit 1
; error K-0016 at 5:7
V.S.A = 1
#IF V.S.A == 1
$GOTO [B]
#ELSE
[B] G01 X5 F1000
#ENDIF
M30
