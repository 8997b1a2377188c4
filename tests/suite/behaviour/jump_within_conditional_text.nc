; run: exit 0
; end X7 Y0 Z4
(a branch of #IF may have jumps inside it, also next to its end, and jumps that leave it)
V.S.A = 1
G01 F2000
#IF V.S.A == 1
P1 = 0
[A] P1 = P1 + 1
X=P1
$IF P1 < 7 $GOTO [A]
#ELSE
Y9
#ENDIF
#IF V.S.A == 1
$GOTO [ALONG]
Y8
#ENDIF
[ALONG] Z4
M30
