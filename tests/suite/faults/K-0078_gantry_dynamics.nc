; run -m gantry --set X2.getriebe[0].dynamik.a_emergency=100: exit 0
; note K-0078 at --set 1:1
G01 X1 F1000
M30
