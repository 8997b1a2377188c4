; run: exit 0
; page 206884875 indirect parameters, the address of one
; end X123.456 Y1.414213562
P120=10 P121=11
PP120=123.456
PP121=SQRT[2.0]
G01 F6000 XP10 YP11
M30
