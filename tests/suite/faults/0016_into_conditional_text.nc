; check: exit 1
; error K-0016 at 4:7
V.S.A = 0
$GOTO [THERE]
#IF V.S.A == 1
[THERE] G01 X5 F1000
#ENDIF
M30
