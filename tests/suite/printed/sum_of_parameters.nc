; run: exit 0
; page 206014219 overview of calculations, addition
; end X6.357
P2=2 P3=4
P1 = P2 + P3 + 0.357
G01 F6000 XP1
M30
